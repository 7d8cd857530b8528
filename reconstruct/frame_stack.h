#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facescan {

/// Captured grey frames in one contiguous block, not owned: frame after frame, row after row, the
/// top row first. A row occupies `row_stride` bytes, of which the first `width` are pixels.
struct FrameStackView {
    const std::uint8_t* pixels = nullptr;
    int count = 0;
    int width = 0;       ///< px
    int height = 0;      ///< px
    int row_stride = 0;  ///< bytes, at least `width`

    std::size_t frameBytes() const { return std::size_t(row_stride) * height; }
    const std::uint8_t* frame(int index) const { return pixels + frameBytes() * index; }
};

/// The same, owned.
struct FrameStack {
    std::vector<std::uint8_t> pixels;  ///< count × height × row_stride bytes
    int count = 0;
    int width = 0;
    int height = 0;
    int row_stride = 0;

    FrameStackView view() const { return {pixels.data(), count, width, height, row_stride}; }
};

}  // namespace facescan
