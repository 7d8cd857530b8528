#include "thesis/stripe_images.h"

#include <algorithm>

namespace facescan::thesis {

Image normalised(const FramePair& pair) {
    Image result(pair.pattern.width, pair.pattern.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const double p = pair.pattern.values[i];
        const double c = pair.complement.values[i];
        result.values[i] = p + c > 0 ? (p - c) / (p + c) : 0;
    }
    return result;
}

Image evenlyLit(const FramePair& pair) {
    Image result = pair.pattern;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] += pair.complement.values[i];
    }
    return result;
}

Image modulation(const std::vector<FramePair>& pairs) {
    Image highest = pairs.front().pattern;
    Image lowest = highest;
    for (const FramePair& pair : pairs) {
        for (std::size_t i = 0; i < highest.values.size(); ++i) {
            const auto [low, high] = std::minmax(pair.pattern.values[i], pair.complement.values[i]);
            highest.values[i] = std::max(highest.values[i], high);
            lowest.values[i] = std::min(lowest.values[i], low);
        }
    }
    for (std::size_t i = 0; i < highest.values.size(); ++i) highest.values[i] -= lowest.values[i];
    return highest;
}

}  // namespace facescan::thesis
