#pragma once

#include <cstdint>
#include <random>

#include "reconstruct/frame_stack.h"

namespace facescan::test {

/// Frames of pixels without any structure; the padding of the rows is random too.
inline FrameStack randomFrames(int count, int width, int height, int row_stride,
                               std::uint32_t seed) {
    FrameStack stack;
    stack.count = count;
    stack.width = width;
    stack.height = height;
    stack.row_stride = row_stride;
    stack.pixels.resize(std::size_t(count) * height * row_stride);
    std::mt19937 random(seed);
    for (std::uint8_t& pixel : stack.pixels) pixel = std::uint8_t(random() & 0xFF);
    return stack;
}

}  // namespace facescan::test
