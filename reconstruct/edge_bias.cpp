#include "reconstruct/edge_bias.h"

#include <algorithm>

#include "reconstruct/kernels/kernels.h"

namespace facescan {
PairDrift driftWithinPairs(const Pattern& pattern,
                           const std::array<ImageMotion, kMaxBits>& image_motions) {
    // Frames from one pair's moment to the next, and from its pattern to its complement.
    const bool interleaved = pattern.order == FrameOrder::interleaved;
    const float between = interleaved ? 2.0f : 1.0f;
    const float within = interleaved ? 1.0f : float(pattern.bits);
    PairDrift drift{};
    for (int pair = 0; pair < pattern.bits; ++pair) {
        const int before = std::max(pair - 1, 0);
        const int after = std::min(pair + 1, pattern.bits - 1);
        const float scale = within / (between * float(after - before));
        drift[pair].column = scale * (image_motions[after].column - image_motions[before].column);
        drift[pair].y = scale * (image_motions[after].y - image_motions[before].y);
    }
    return drift;
}

void correctEdgeBias(double lens_blur_px, const PairDrift& drift, int bits,
                     std::vector<std::uint8_t>& measured, VertexGrid& grid) {
    // Neighbours beyond the borders are none.
    measured.assign(grid.columns + 2, 0);
    std::uint8_t* const flags = measured.data() + 1;
    for (int code = 1; code < grid.codes; ++code) {
        const auto [first, end] = grid.extent[code];
        if (first >= end) continue;
        const std::size_t row = grid.index(code, 0);
        for (int x = std::max(first - 1, 0); x < std::min(end + 1, grid.columns); ++x) {
            flags[x] = grid.cell[row + x] == Cell::measured;
        }
        const std::size_t i = row + first;
        const ImagePoint& pair_drift = drift[pairOfEdge(code, bits)];
        kernels().correctBias({flags + first, &grid.y[i], &grid.gradient_x[i], &grid.gradient_y[i],
                               &grid.drift_gain[i]},
                              {.variance = float(lens_blur_px * lens_blur_px),
                               .drift_column = pair_drift.column,
                               .drift_y = pair_drift.y},
                              end - first, &grid.scratch[i]);
    }
    grid.y.swap(grid.scratch);
}

}  // namespace facescan
