#include "reconstruct/stripe_images.h"

#include <array>
#include <bit>
#include <cstring>

namespace facescan {
namespace {

constexpr int kBlock = 8;

/// Transposes 8 × 8 pixels: two by two within each pair of rows, then pairs, then fours.
void transposeBlock(const std::uint8_t* source, std::ptrdiff_t source_stride, std::uint8_t* target,
                    std::ptrdiff_t target_stride) {
    static_assert(std::endian::native == std::endian::little);
    std::array<std::uint64_t, kBlock> rows;
    for (int r = 0; r < kBlock; ++r) std::memcpy(&rows[r], source + r * source_stride, kBlock);
    const auto swap = [&](int distance, std::uint64_t mask) {
        for (int r = 0; r < kBlock; ++r) {
            if (r & distance) continue;
            std::uint64_t& upper = rows[r];
            std::uint64_t& lower = rows[r + distance];
            const std::uint64_t changed = (upper >> 8 * distance ^ lower) & mask;
            lower ^= changed;
            upper ^= changed << 8 * distance;
        }
    };
    swap(1, 0x00FF00FF00FF00FF);
    swap(2, 0x0000FFFF0000FFFF);
    swap(4, 0x00000000FFFFFFFF);
    for (int r = 0; r < kBlock; ++r) std::memcpy(target + r * target_stride, &rows[r], kBlock);
}

void transpose(const std::uint8_t* source, std::ptrdiff_t source_stride, int width, int height,
               std::uint8_t* target) {
    const int whole_width = width - width % kBlock;
    const int whole_height = height - height % kBlock;
    // A strip of columns at a time, so that whole lines of the target are written.
    for (int x = 0; x < whole_width; x += kBlock) {
        for (int y = 0; y < whole_height; y += kBlock) {
            transposeBlock(source + y * source_stride + x, source_stride,
                           target + std::ptrdiff_t(x) * height + y, height);
        }
    }
    const auto copy = [&](int x, int y) {
        target[std::ptrdiff_t(x) * height + y] = source[y * source_stride + x];
    };
    for (int x = 0; x < whole_width; ++x) {
        for (int y = whole_height; y < height; ++y) copy(x, y);
    }
    for (int x = whole_width; x < width; ++x) {
        for (int y = 0; y < height; ++y) copy(x, y);
    }
}

const std::uint8_t* firstPixel(const FrameStackView& frames, const ScanDescription& scan,
                               int index) {
    return frames.frame(scan.first_frame + index) +
           std::ptrdiff_t(scan.image.y) * frames.row_stride + scan.image.x;
}

std::size_t imageBytes(const ScanDescription& scan) {
    return std::size_t(scan.image.width) * scan.image.height;
}

}  // namespace

StripeImages stripeImages(const FrameStackView& frames, const ScanDescription& scan,
                          std::vector<std::uint8_t>& buffer) {
    const Rect& crop = scan.image;
    const Pattern& pattern = scan.pattern;
    const bool turned = pattern.axis == CodeAxis::x;
    if (turned) buffer.resize(imageBytes(scan) * pattern.frameCount());

    StripeImages images;
    images.bits = pattern.bits;
    images.width = turned ? crop.height : crop.width;
    images.height = turned ? crop.width : crop.height;
    images.row_stride = turned ? images.width : frames.row_stride;

    for (int pair = 0; pair < pattern.bits; ++pair) {
        for (const bool complement : {false, true}) {
            const int index = pattern.frameIndex(pair, complement);
            (complement ? images.complement : images.pattern)[pair] =
                turned ? buffer.data() + imageBytes(scan) * index : firstPixel(frames, scan, index);
        }
    }
    return images;
}

void turnFrame(const FrameStackView& frames, const ScanDescription& scan, int index,
               std::vector<std::uint8_t>& buffer) {
    if (scan.pattern.axis != CodeAxis::x) return;
    transpose(firstPixel(frames, scan, index), frames.row_stride, scan.image.width,
              scan.image.height, buffer.data() + imageBytes(scan) * index);
}

}  // namespace facescan
