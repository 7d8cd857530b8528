#include "render/offscreen_target.h"

#include <algorithm>
#include <string>

#include "render/render_error.h"

namespace facescan {
namespace {

void requireSize(int width, int height) {
    GLint largest_texture = 0;
    GLint largest_renderbuffer = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_texture);
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest_renderbuffer);
    const int largest = std::min(largest_texture, largest_renderbuffer);
    if (width > largest || height > largest) {
        throw RenderError("OpenGL ES: no off-screen picture of " + std::to_string(width) + " × " +
                          std::to_string(height) + ": at most " + std::to_string(largest) +
                          " a side here; ask for a smaller picture");
    }
}

}  // namespace

OffscreenTarget::OffscreenTarget(int width, int height) : width_(width), height_(height) {
    requireSize(width, height);

    // A texture, since GLES 2.0 promises no renderbuffer with 8 bits a channel.
    glBindTexture(GL_TEXTURE_2D, colour_.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);

    // 16 bits, which GLES 2.0 promises, resolve better than 0.01 mm: a view's near and far plane
    // enclose the mesh tightly.
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, width, height);

    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw RenderError("OpenGL ES: no off-screen picture of " + std::to_string(width) + " × " +
                          std::to_string(height) + ": ask for a smaller picture");
    }
}

void OffscreenTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, width_, height_);
}

void OffscreenTarget::read(std::vector<std::uint8_t>& rgba) const {
    rgba.resize(std::size_t(width_) * height_ * 4);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

}  // namespace facescan
