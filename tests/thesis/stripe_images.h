#pragma once

#include <vector>

#include "thesis/image.h"

/// The images that the thesis derives from the pairs before it decodes.
namespace facescan::thesis {

/// (P − C) / (P + C): the stripes without reflectance and ambient light, −1 … 1; 0 where P + C is.
Image normalised(const FramePair& pair);

/// "Texture 2", P + C: the scene as if evenly lit, 0 … 2.
Image evenlyLit(const FramePair& pair);

/// The largest less the smallest value of each pixel over all frames, 0 … 1.
Image modulation(const std::vector<FramePair>& pairs);

}  // namespace facescan::thesis
