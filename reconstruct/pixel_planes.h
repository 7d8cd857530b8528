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
    std::vector<std::uint16_t> stripe;      ///< the number that the signs of all pairs spell
    std::vector<std::uint8_t> modulation;   ///< max − min over the pattern frames, grey levels
    std::vector<std::uint16_t> brightness;  ///< sum over the pattern frames: the evenly lit scene
    int saturated = 0;                      ///< pixels at 255 in some frame
    std::vector<std::uint8_t> low;          ///< smallest grey level; the modulation's plane holds
                                            ///< the largest until all pairs are there

    std::size_t index(int x, int y) const { return std::size_t(y) * width + x; }
};

/// Lays out planes to which no pair has been added.
void beginPixelPlanes(const StripeImages& images, PixelPlanes& planes);

/// The first half of decoding: adds the pairs first … end − 1 to a row of the planes. Pairs come in
/// their order; with the last one the row is complete.
///
/// A pair's sign at a pixel is that of pattern − complement, averaged over the neighbours along the
/// stripe with weights 1 2 1: noise across the stripe's length goes, the edge stays where it is.
/// The signs are a Gray codeword, kept as the number of its stripe.
void addPairs(const StripeImages& images, int first, int end, int y, PixelPlanes& planes);

}  // namespace facescan
