#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace facescan {

/// Owns the name of an OpenGL object. The context it was made in is current when it goes.
template <class Lifetime>
class GlObject {
public:
    GlObject() : id_(Lifetime::create()) {}
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlObject() {
        if (id_ != 0) Lifetime::destroy(id_);
    }

    GLuint id() const { return id_; }

private:
    GLuint id_;
};

struct GlBufferLifetime {
    static GLuint create() {
        GLuint id = 0;
        glGenBuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};

struct GlTextureLifetime {
    static GLuint create() {
        GLuint id = 0;
        glGenTextures(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};

struct GlRenderbufferLifetime {
    static GLuint create() {
        GLuint id = 0;
        glGenRenderbuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteRenderbuffers(1, &id); }
};

struct GlFramebufferLifetime {
    static GLuint create() {
        GLuint id = 0;
        glGenFramebuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};

using GlBuffer = GlObject<GlBufferLifetime>;
using GlTexture = GlObject<GlTextureLifetime>;
using GlRenderbuffer = GlObject<GlRenderbufferLifetime>;
using GlFramebuffer = GlObject<GlFramebufferLifetime>;

}  // namespace facescan
