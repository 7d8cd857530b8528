#include "render/gl_program.h"

#include <string>

#include "render/render_error.h"

namespace facescan {
namespace {

std::string firstLine(const std::string& log) {
    return log.substr(0, log.find_first_of("\r\n"));
}

GLuint compile(GLenum type, const char* source) {
    const GLuint shader = glCreateShader(type);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    return shader;
}

/// Attaches a shader that lives exactly as long as the program.
void attach(GLuint program, GLenum type, const char* source) {
    const GLuint shader = compile(type, source);
    glAttachShader(program, shader);
    glDeleteShader(shader);
}

std::string linkLog(GLuint program) {
    char log[512] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    return firstLine(log);
}

}  // namespace

GlProgram::GlProgram(const char* vertex_source, const char* fragment_source,
                     std::initializer_list<const char*> attributes)
    : id_(glCreateProgram()) {
    attach(id_, GL_VERTEX_SHADER, vertex_source);
    attach(id_, GL_FRAGMENT_SHADER, fragment_source);
    GLuint location = 0;
    for (const char* attribute : attributes) glBindAttribLocation(id_, location++, attribute);
    glLinkProgram(id_);

    GLint linked = GL_FALSE;
    glGetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        const std::string log = linkLog(id_);
        glDeleteProgram(id_);
        throw RenderError("OpenGL ES: the driver rejects a shader (" + log + "): update Mesa");
    }
}

GlProgram::~GlProgram() {
    glDeleteProgram(id_);
}

}  // namespace facescan
