#include "sim/lens.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/random.h"

namespace facescan::sim {

LensFilter makeLensFilter(double sigma_px, int per_side) {
    LensFilter filter{.per_side = per_side, .margin_px = 0, .weights = {}};
    if (sigma_px > 0) filter.margin_px = int(std::ceil(3 * sigma_px));
    const int taps = (2 * filter.margin_px + 1) * per_side;
    filter.weights.assign(taps, 1.0f / float(per_side));
    if (sigma_px <= 0) return filter;
    float sum = 0;
    for (int i = 0; i < taps; ++i) {
        const float x = (float(i) + 0.5f) / float(per_side) - float(taps) / float(2 * per_side);
        const float s = float(sigma_px);
        filter.weights[i] = normalShareBelow((x + 0.5f) / s) - normalShareBelow((x - 0.5f) / s);
        sum += filter.weights[i];
    }
    for (float& weight : filter.weights) weight /= sum;
    return filter;
}

void collect(const LensFilter& filter, std::span<const float> samples, int width, int height,
             std::span<float> pixels) {
    const int s = filter.per_side, taps = int(filter.weights.size());
    const int columns = (width + 2 * filter.margin_px) * s;
    const int rows = (height + 2 * filter.margin_px) * s;
    std::vector<float> line(width);
    std::fill(pixels.begin(), pixels.end(), 0.0f);
    for (int row = 0; row < rows; ++row) {
        const float* source = samples.data() + std::ptrdiff_t(row) * columns;
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int i = 0; i < taps; ++i) sum += filter.weights[i] * source[x * s + i];
            line[x] = sum;
        }
        // This row of samples is tap `row − y s` of pixel row y.
        const int last = std::min(height - 1, row / s);
        for (int y = last; y >= 0 && row - y * s < taps; --y) {
            const float weight = filter.weights[row - y * s];
            float* target = pixels.data() + std::ptrdiff_t(y) * width;
            for (int x = 0; x < width; ++x) target[x] += weight * line[x];
        }
    }
}

}  // namespace facescan::sim
