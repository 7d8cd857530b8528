#pragma once

#include <vector>

#include "thesis/image.h"
#include "thesis/surface.h"

namespace facescan::thesis {

inline constexpr int kNoCode = -1;

/// The stripe that each pixel shows.
struct CodeImage {
    int at(int x, int y) const { return codes[std::size_t(y) * width + x]; }

    int width = 0;
    int height = 0;
    std::vector<int> codes;  ///< kNoCode where the projector's light does not reach
};

/// Reads each pixel's Gray codeword off the signs of its normalised values, coarsest pair first.
/// @param min_modulation  below it a pixel has no code; 0 … 1
CodeImage decodePixels(const std::vector<Image>& normalised, const Image& modulation,
                       double min_modulation);

/// A place where the code changes.
struct Transition {
    PlanePoint place;  ///< midway between the two pixels, one above the other
    int code = 0;      ///< of the edge between the two stripes
};

/// Every place where two pixels, one above the other, show neighbouring stripes: column by column,
/// downwards.
std::vector<Transition> transitions(const CodeImage& codes);

}  // namespace facescan::thesis
