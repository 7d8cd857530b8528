#pragma once

#include "reconstruct/image.h"
#include "thesis/image.h"

namespace facescan::thesis {

/// "Texture 1", the mesh's texture: average of the finest pair, gamma correction, mean over 5 × 5
/// pixels, and a stretch that takes the darkest pixel to 0 and the brightest to 255.
GreyImage texture(const FramePair& finest, double gamma);

/// The mean over the `size` × `size` pixels around each; at the border over those that there are.
Image meanFiltered(const Image& image, int size);

}  // namespace facescan::thesis
