#include "render/texture_fit.h"

#include <algorithm>

namespace facescan {
namespace {

int divideUp(int value, int divisor) {
    return (value + divisor - 1) / divisor;
}

std::uint8_t blockMean(const GreyImage& image, const Rect& block) {
    std::uint64_t sum = 0;
    for (int y = block.y; y < block.y + block.height; ++y) {
        const std::uint8_t* row = image.row(y) + block.x;
        for (int x = 0; x < block.width; ++x) sum += row[x];
    }
    const std::uint64_t count = std::uint64_t(block.width) * block.height;
    return std::uint8_t((sum + count / 2) / count);
}

}  // namespace

GreyImage fitTexture(const GreyImage& image, int max_side) {
    const int factor = divideUp(std::max(image.width, image.height), max_side);
    if (factor <= 1) return image;

    GreyImage fitted{divideUp(image.width, factor), divideUp(image.height, factor), {}};
    fitted.pixels.reserve(std::size_t(fitted.width) * fitted.height);
    for (int y = 0; y < image.height; y += factor) {
        for (int x = 0; x < image.width; x += factor) {
            fitted.pixels.push_back(blockMean(image, {x, y, std::min(factor, image.width - x),
                                                      std::min(factor, image.height - y)}));
        }
    }
    return fitted;
}

}  // namespace facescan
