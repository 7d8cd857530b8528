#pragma once

#include <cstdint>
#include <vector>

#include "render/gl_object.h"

namespace facescan {

/// A picture in the GPU's memory to draw into, with a depth buffer. The context it was made in is
/// current when it is used and when it goes.
class OffscreenTarget {
public:
    /// @throws RenderError when the driver cannot have one of this size
    OffscreenTarget(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }

    /// Drawing goes here from now on, over the whole picture.
    void bind() const;

    /// What was drawn: RGBA, four bytes a pixel, the bottom row first.
    void read(std::vector<std::uint8_t>& rgba) const;

private:
    int width_;
    int height_;
    GlTexture colour_;
    GlRenderbuffer depth_;
    GlFramebuffer framebuffer_;
};

}  // namespace facescan
