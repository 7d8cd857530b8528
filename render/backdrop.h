#pragma once

#include "render/gl_object.h"
#include "render/gl_program.h"

namespace facescan {

/// A calm dark gradient, light in the upper middle, over the whole viewport and behind everything.
class Backdrop {
public:
    Backdrop();

    /// Overwrites colour and depth of the bound framebuffer.
    void draw() const;

private:
    GlProgram program_;
    GlBuffer corners_;
};

}  // namespace facescan
