#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facescan {

/// An 8-bit sRGB image, three bytes a pixel, rows from the top, without padding:
/// `pixels.size() == 3 * width * height`.
struct RgbImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;

    const std::uint8_t* row(int y) const { return pixels.data() + std::size_t(y) * width * 3; }
    std::uint8_t* row(int y) { return pixels.data() + std::size_t(y) * width * 3; }
};

}  // namespace facescan
