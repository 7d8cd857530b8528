#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reconstruct/stripe_images.h"

namespace facescan {

/// What one pass over all frames leaves of each pixel, in the orientation of the stripe images.
struct PixelPlanes {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> codeword;   ///< bit bits − 1 − k: the sign of pair k
    std::vector<std::uint8_t> modulation;  ///< max − min over the pattern frames, grey levels

    std::vector<std::uint16_t> brightness;  ///< sum over the pattern frames: the evenly lit scene
    int saturated = 0;                      ///< pixels at 255 in some frame
    std::vector<std::int16_t> scratch_difference;  ///< one row, and a pixel at either end
    std::vector<std::uint8_t> scratch_low;         ///< one row

    std::size_t index(int x, int y) const { return std::size_t(y) * width + x; }
};

/// The first half of decoding. A pair's sign at a pixel is that of pattern − complement, averaged
/// over the neighbours along the stripe with weights 1 2 1: noise across the stripe's length goes,
/// the edge stays where it is.
void computePixelPlanes(const StripeImages& images, PixelPlanes& planes);

}  // namespace facescan
