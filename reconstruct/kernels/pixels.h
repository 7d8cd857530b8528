#pragma once

#include <algorithm>
#include <cstdint>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"

namespace facescan {

// Kernels over whole pixels, in integers: plain loops that the compiler vectorises. `Form` only
// keeps the forms' instances apart.

template <typename Form>
FACESCAN_KERNEL void startRow(int width, const PixelRow& row) {
    std::fill_n(row.stripe, width, std::uint16_t(0));
    std::fill_n(row.brightness, width, std::uint16_t(0));
    std::fill_n(row.low, width, std::uint8_t(255));
    std::fill_n(row.high, width, std::uint8_t(0));
}

/// @param difference  with room for a pixel before and one after; these are left to the caller
FACESCAN_INLINE void accumulate(const std::uint8_t* __restrict pattern,
                                const std::uint8_t* __restrict complement, int count,
                                std::int16_t* __restrict difference,
                                std::uint16_t* __restrict brightness, std::uint8_t* __restrict low,
                                std::uint8_t* __restrict high) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        const std::uint8_t p = pattern[x];
        const std::uint8_t c = complement[x];
        difference[x] = std::int16_t(p - c);
        brightness[x] = std::uint16_t(brightness[x] + p + c);
        low[x] = std::min(low[x], std::min(p, c));
        high[x] = std::max(high[x], std::max(p, c));
    }
}

FACESCAN_INLINE void appendSigns(const std::int16_t* __restrict difference, int count,
                                 std::uint16_t* __restrict stripe) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        const std::int16_t smoothed =
            std::int16_t(difference[x - 1] + 2 * difference[x] + difference[x + 1]);
        // From Gray to binary: each bit is the last one, turned over where the sign is set.
        const std::uint16_t bit = std::uint16_t((stripe[x] & 1) ^ (smoothed > 0 ? 1 : 0));
        stripe[x] = std::uint16_t(stripe[x] + stripe[x] + bit);
    }
}

template <typename Form>
FACESCAN_KERNEL void addPairs(const PairRows& pairs, int width, const PixelRow& row) {
    constexpr int kChunk = 512;
    std::int16_t memory[kChunk + 2];
    std::int16_t* difference = memory + 1;
    for (int first = 0; first < width; first += kChunk) {
        const int count = std::min(kChunk, width - first);
        const int left = first > 0 ? -1 : 0;
        const int right = first + count < width ? count : count - 1;
        for (int pair = 0; pair < pairs.count; ++pair) {
            const std::uint8_t* p = pairs.pattern[pair] + first;
            const std::uint8_t* c = pairs.complement[pair] + first;
            accumulate(p, c, count, difference, row.brightness + first, row.low + first,
                       row.high + first);
            difference[-1] = std::int16_t(p[left] - c[left]);
            difference[count] = std::int16_t(p[right] - c[right]);
            appendSigns(difference, count, row.stripe + first);
        }
    }
}

template <typename Form>
FACESCAN_KERNEL int finishRow(int width, const PixelRow& row) {
    const std::uint8_t* __restrict low = row.low;
    std::uint8_t* __restrict high = row.high;
    int saturated = 0;
#pragma GCC ivdep
    for (int x = 0; x < width; ++x) {
        saturated += high[x] == 255;
        high[x] = std::uint8_t(high[x] - low[x]);
    }
    return saturated;
}

template <typename Form>
FACESCAN_KERNEL EdgeCounts classifyEdges(const std::uint16_t* __restrict stripe_above,
                                         const std::uint16_t* __restrict stripe_below,
                                         const std::uint8_t* __restrict modulation_above,
                                         const std::uint8_t* __restrict modulation_below,
                                         int min_modulation, int width,
                                         std::uint8_t* __restrict edge_class) {
    const auto least = std::uint8_t(min_modulation);
#pragma GCC ivdep
    for (int x = 0; x < width; ++x) {
        const std::uint8_t modulation = std::min(modulation_above[x], modulation_below[x]);
        const std::uint16_t lit = modulation >= least ? 0xFFFF : 0;
        const std::uint16_t step = std::uint16_t(stripe_below[x] - stripe_above[x]) & lit;
        const std::uint16_t bits = stripe_below[x] ^ stripe_above[x];
        const std::uint16_t changed = bits ^ bits >> 1;  // of the Gray codewords
        const std::uint16_t beyond1 = changed & std::uint16_t(changed - 1);
        const std::uint16_t beyond2 = beyond1 & std::uint16_t(beyond1 - 1);
        const std::uint16_t beyond3 = beyond2 & std::uint16_t(beyond2 - 1);
        const int some = beyond1 != 0 && beyond3 == 0 ? int(kAmbiguousEdge) : int(kNamelessEdge);
        const int any = step != 0 ? some : int(kNoEdge);
        const int rising = step == 1 ? int(kRisingEdge) : any;
        edge_class[x] = std::uint8_t(step == 0xFFFF ? int(kFallingEdge) : rising);
    }
    EdgeCounts counts;
    for (int x = 0; x < width; ++x) {
        counts.found += edge_class[x] != kNoEdge;
        counts.rising += edge_class[x] == kRisingEdge;
        counts.falling += edge_class[x] == kFallingEdge;
        counts.ambiguous += edge_class[x] == kAmbiguousEdge;
    }
    return counts;
}

}  // namespace facescan
