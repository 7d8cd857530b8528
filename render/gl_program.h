#pragma once

#include <epoxy/gl.h>

#include <initializer_list>

namespace facescan {

/// A linked pair of shaders. The context it was made in is current when it is used and when it
/// goes.
class GlProgram {
public:
    /// @param attributes  names of the vertex attributes, in the order of their locations from 0
    /// @throws RenderError with the driver's first words when it rejects the source
    GlProgram(const char* vertex_source, const char* fragment_source,
              std::initializer_list<const char*> attributes);
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;
    ~GlProgram();

    void use() const { glUseProgram(id_); }
    GLint uniform(const char* name) const { return glGetUniformLocation(id_, name); }

private:
    GLuint id_;
};

}  // namespace facescan
