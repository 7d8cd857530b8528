#pragma once

#include "reconstruct/image.h"

namespace facescan {

/// The image, made smaller by the least whole factor with which neither side exceeds `max_side`;
/// each pixel is the mean of the square of pixels that it stands for (of the part of it that lies
/// inside the image, at the right and lower border). As it is where it fits.
GreyImage fitTexture(const GreyImage& image, int max_side);

}  // namespace facescan
