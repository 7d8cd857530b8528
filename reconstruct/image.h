#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facescan {

/// A rectangle of pixels: columns x … x + width − 1, rows y … y + height − 1.
struct Rect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    friend bool operator==(const Rect&, const Rect&) = default;
};

/// An 8-bit grey image, rows from the top, without padding: `pixels.size() == width * height`.
struct GreyImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;

    const std::uint8_t* row(int y) const { return pixels.data() + std::size_t(y) * width; }
    std::uint8_t* row(int y) { return pixels.data() + std::size_t(y) * width; }
};

}  // namespace facescan
