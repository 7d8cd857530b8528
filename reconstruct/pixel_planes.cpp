#include "reconstruct/pixel_planes.h"

#include <algorithm>

namespace facescan {
namespace {

void accumulatePair(const std::uint8_t* __restrict pattern,
                    const std::uint8_t* __restrict complement, int width,
                    std::int16_t* __restrict difference, std::uint16_t* __restrict brightness,
                    std::uint8_t* __restrict low, std::uint8_t* __restrict high) {
#pragma GCC ivdep
    for (int x = 0; x < width; ++x) {
        const std::uint8_t p = pattern[x];
        const std::uint8_t c = complement[x];
        difference[x] = std::int16_t(p - c);
        brightness[x] = std::uint16_t(brightness[x] + p + c);
        low[x] = std::min(low[x], std::min(p, c));
        high[x] = std::max(high[x], std::max(p, c));
    }
}

/// Appends one bit to each codeword: whether the difference, smoothed along the row, is positive.
/// `difference` has one readable element before and one after the row.
void appendSigns(const std::int16_t* __restrict difference, int width,
                 std::uint16_t* __restrict codeword) {
#pragma GCC ivdep
    for (int x = 0; x < width; ++x) {
        const std::int16_t smoothed =
            std::int16_t(difference[x - 1] + 2 * difference[x] + difference[x + 1]);
        codeword[x] = std::uint16_t(codeword[x] * 2 + (smoothed > 0 ? 1 : 0));
    }
}

}  // namespace

void computePixelPlanes(const StripeImages& images, PixelPlanes& planes) {
    const int width = images.width;
    const std::size_t pixels = std::size_t(width) * images.height;
    planes.width = width;
    planes.height = images.height;
    planes.codeword.assign(pixels, 0);
    planes.modulation.resize(pixels);
    planes.brightness.assign(pixels, 0);
    planes.saturated = 0;
    planes.scratch_difference.resize(std::size_t(width) + 2);
    planes.scratch_low.resize(width);

    std::int16_t* difference = planes.scratch_difference.data() + 1;
    std::uint8_t* low = planes.scratch_low.data();
    for (int y = 0; y < images.height; ++y) {
        std::uint16_t* codeword = planes.codeword.data() + planes.index(0, y);
        std::uint16_t* brightness = planes.brightness.data() + planes.index(0, y);
        std::uint8_t* high = planes.modulation.data() + planes.index(0, y);
        std::fill_n(low, width, std::uint8_t(255));
        std::fill_n(high, width, std::uint8_t(0));
        for (int pair = 0; pair < images.bits; ++pair) {
            accumulatePair(images.patternRow(pair, y), images.complementRow(pair, y), width,
                           difference, brightness, low, high);
            difference[-1] = difference[0];
            difference[width] = difference[width - 1];
            appendSigns(difference, width, codeword);
        }
        planes.saturated += int(std::count(high, high + width, std::uint8_t(255)));
        for (int x = 0; x < width; ++x) high[x] = std::uint8_t(high[x] - low[x]);
    }
}

}  // namespace facescan
