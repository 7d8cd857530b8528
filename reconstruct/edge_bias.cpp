#include "reconstruct/edge_bias.h"

#include <algorithm>
#include <cmath>

namespace facescan {
namespace {

/// dy/dx of the stripe edge at a cell, from its neighbours on the same surface; 0 where unknown.
float edgeSlope(const VertexGrid& grid, std::size_t i, int column) {
    constexpr float kSteepest = 3.0f;
    float sum = 0;
    int sides = 0;
    if (column > 0 && grid.cell[i - 1] == Cell::measured) {
        sum += grid.y[i] - grid.y[i - 1];
        ++sides;
    }
    if (column + 1 < grid.columns && grid.cell[i + 1] == Cell::measured) {
        sum += grid.y[i + 1] - grid.y[i];
        ++sides;
    }
    if (sides == 0) return 0;
    const float slope = sum / float(sides);
    return std::fabs(slope) < kSteepest ? slope : 0.0f;
}

}  // namespace

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

void correctEdgeBias(double lens_blur_px, const PairDrift& drift, int bits, VertexGrid& grid) {
    constexpr float kLargestShift = 0.5f;  // px; beyond it the model does not hold
    const float variance = float(lens_blur_px * lens_blur_px);
    grid.scratch = grid.y;
    for (int code = 1; code < grid.codes; ++code) {
        const ImagePoint& pair_drift = drift[pairOfEdge(code, bits)];
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::empty) continue;
            const float blur =
                variance * (grid.gradient_y[i] - grid.gradient_x[i] * edgeSlope(grid, i, column));
            const float change =
                pair_drift.column * grid.gradient_x[i] + pair_drift.y * grid.gradient_y[i];
            const float shift = blur + grid.drift_gain[i] * change;
            grid.scratch[i] = grid.y[i] + std::clamp(shift, -kLargestShift, kLargestShift);
        }
    }
    grid.y.swap(grid.scratch);
}

}  // namespace facescan
