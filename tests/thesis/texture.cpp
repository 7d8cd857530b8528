#include "thesis/texture.h"

#include <algorithm>
#include <cmath>

namespace facescan::thesis {

Image meanFiltered(const Image& image, int size) {
    Image result(image.width, image.height);
    const int reach = size / 2;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            double sum = 0;
            int count = 0;
            for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v) {
                for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach);
                     ++u) {
                    sum += image.at(u, v);
                    ++count;
                }
            }
            result.at(x, y) = sum / count;
        }
    }
    return result;
}

GreyImage texture(const FramePair& finest, double gamma) {
    Image image(finest.pattern.width, finest.pattern.height);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const double average = (finest.pattern.values[i] + finest.complement.values[i]) / 2;
        image.values[i] = std::pow(average, gamma);
    }
    image = meanFiltered(image, 5);

    const auto [low, high] = std::minmax_element(image.values.begin(), image.values.end());
    const double darkest = *low;
    const double contrast = *high - darkest;
    GreyImage result{image.width, image.height, {}};
    for (const double value : image.values) {
        const double stretched = contrast > 0 ? (value - darkest) / contrast : 0;
        result.pixels.push_back(std::uint8_t(std::lround(255 * stretched)));
    }
    return result;
}

}  // namespace facescan::thesis
