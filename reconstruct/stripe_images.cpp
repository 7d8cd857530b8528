#include "reconstruct/stripe_images.h"

#include <algorithm>

namespace facescan {
namespace {

/// Transposes in blocks that stay in the first-level cache.
void transpose(const std::uint8_t* source, std::ptrdiff_t source_stride, int width, int height,
               std::uint8_t* target) {
    constexpr int kBlock = 32;
    for (int y0 = 0; y0 < height; y0 += kBlock) {
        const int y1 = std::min(y0 + kBlock, height);
        for (int x0 = 0; x0 < width; x0 += kBlock) {
            const int x1 = std::min(x0 + kBlock, width);
            for (int x = x0; x < x1; ++x) {
                for (int y = y0; y < y1; ++y) {
                    target[std::ptrdiff_t(x) * height + y] = source[y * source_stride + x];
                }
            }
        }
    }
}

}  // namespace

StripeImages stripeImages(const FrameStackView& frames, const ScanDescription& scan,
                          std::vector<std::uint8_t>& buffer) {
    const Rect& crop = scan.image;
    const Pattern& pattern = scan.pattern;
    const bool turned = pattern.axis == CodeAxis::x;
    const std::size_t turned_bytes = std::size_t(crop.width) * crop.height;
    if (turned) buffer.resize(turned_bytes * pattern.frameCount());

    StripeImages images;
    images.bits = pattern.bits;
    images.width = turned ? crop.height : crop.width;
    images.height = turned ? crop.width : crop.height;
    images.row_stride = turned ? images.width : frames.row_stride;

    for (int pair = 0; pair < pattern.bits; ++pair) {
        for (const bool complement : {false, true}) {
            const int index = pattern.frameIndex(pair, complement);
            const std::uint8_t* first_pixel = frames.frame(scan.first_frame + index) +
                                              std::ptrdiff_t(crop.y) * frames.row_stride + crop.x;
            if (turned) {
                std::uint8_t* copy = buffer.data() + turned_bytes * index;
                transpose(first_pixel, frames.row_stride, crop.width, crop.height, copy);
                first_pixel = copy;
            }
            (complement ? images.complement : images.pattern)[pair] = first_pixel;
        }
    }
    return images;
}

}  // namespace facescan
