#pragma once

#include <span>
#include <vector>

namespace facescan::sim {

/// What a pixel collects from a lattice of `per_side`² samples a pixel: its own square blurred by
/// the lens' Gaussian, as weights along one axis (the filter is separable). They sum to 1.
struct LensFilter {
    int per_side = 1;
    int margin_px = 0;           ///< pixels around a pixel that contribute
    std::vector<float> weights;  ///< (2 · margin_px + 1) · per_side, centred on the pixel
};

LensFilter makeLensFilter(double sigma_px, int per_side);

/// Filters the samples of a block of pixels with its margin.
///
/// @param samples (height + 2 margin) · per_side rows of (width + 2 margin) · per_side
/// @param pixels  height rows of width; overwritten
void collect(const LensFilter& filter, std::span<const float> samples, int width, int height,
             std::span<float> pixels);

}  // namespace facescan::sim
