#pragma once

#include <cstdint>
#include <cstring>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"

namespace facescan {

/// Eight integers side by side, in vectors of the compiler's own: unrolled loops over so few it
/// does not turn into vectors by itself.
using EightBytes [[gnu::vector_size(8)]] = std::uint8_t;
using EightWords [[gnu::vector_size(16)]] = std::uint16_t;
using EightInts [[gnu::vector_size(32)]] = std::int32_t;
static_assert(EdgeRun::kMost == 8);

FACESCAN_INLINE EightWords loadEight(const std::uint8_t* p) {
    EightBytes bytes;
    std::memcpy(&bytes, p, sizeof bytes);
    return __builtin_convertvector(bytes, EightWords);
}
FACESCAN_INLINE EightWords loadEight(const std::uint16_t* p) {
    EightWords words;
    std::memcpy(&words, p, sizeof words);
    return words;
}
template <typename Vector>
FACESCAN_INLINE void storeEight(Vector values, std::int32_t* p) {
    const EightInts ints = __builtin_convertvector(values, EightInts);
    std::memcpy(p, &ints, sizeof ints);
}

/// Sums three neighbours with the weights 1 2 1.
template <typename Pixel>
FACESCAN_INLINE EightWords sumNeighbours(const Pixel* row, int left, int right) {
    const EightWords middle = loadEight(row);
    return loadEight(row + left) + middle + middle + loadEight(row + right);
}

template <typename Form>
FACESCAN_KERNEL void gatherEdges(const EdgeRun& run, int first, EdgeBatch& batch) {
    using SignedWords [[gnu::vector_size(16)]] = std::int16_t;
    for (int r = 0; r < 4; ++r) {
        const EightWords pattern = sumNeighbours(run.pattern + run.rows[r], run.left, run.right);
        const EightWords complement =
            sumNeighbours(run.complement + run.rows[r], run.left, run.right);
        storeEight(SignedWords(pattern - complement), batch.difference[r].data() + first);
        storeEight(pattern + complement, batch.sum[r].data() + first);
        storeEight(sumNeighbours(run.brightness + run.brightness_rows[r], run.left, run.right),
                   batch.brightness[r].data() + first);
    }
    const std::uint16_t* above = run.brightness + run.brightness_rows[1];
    const std::uint16_t* below = run.brightness + run.brightness_rows[2];
    storeEight(loadEight(above + run.left) + loadEight(below + run.left),
               batch.brightness_left.data() + first);
    storeEight(loadEight(above + run.right) + loadEight(below + run.right),
               batch.brightness_right.data() + first);
}

/// d / s, 0 where s is 0.
template <typename L>
FACESCAN_INLINE L ratio(L d, L s) {
    return select(L(0.0f) < s, d * reciprocal(s), L(0.0f));
}

template <typename Lanes>
FACESCAN_KERNEL void locateEdges(EdgeBatch& batch, float frames) {
    static_assert(EdgeBatch::kSize % Lanes::kCount == 0);
    using L = Lanes;
    for (int i = 0; i < batch.count; i += L::kCount) {
        const auto at = [i](const auto& column)
                            FACESCAN_INLINE_LAMBDA { return L::load(column.data() + i); };
        const L d1 = at(batch.difference[1]);
        const L d2 = at(batch.difference[2]);
        const L n0 = ratio(at(batch.difference[0]), at(batch.sum[0]));
        const L n1 = ratio(d1, at(batch.sum[1]));
        const L n2 = ratio(d2, at(batch.sum[2]));
        const L n3 = ratio(at(batch.difference[3]), at(batch.sum[3]));

        // The line through the inner two; and, by weights ½ 1 1 ½, through all four: weighted mean
        // and slope of the values at −1, 0, 1, 2, about the middle ½.
        const L inner = n1 * reciprocal(n1 - n2);
        const L mean = (L(0.5f) * (n0 + n3) + n1 + n2) * L(1.0f / 3.0f);
        const L slope = (L(0.75f) * (n3 - n0) + L(0.5f) * (n2 - n1)) * L(1.0f / 2.75f);
        const L four = L(0.5f) - mean * reciprocal(slope);
        const auto agree = L::Mask::load(batch.inside.data() + i) & (L(0.0f) < slope * (n2 - n1)) &
                           (abs(four - inner) < L(0.5f));
        (at(batch.row) + select(agree, four, inner)).store(batch.place.data() + i);

        const L contrast = L(0.25f) * abs(d1 - d2);
        contrast.store(batch.contrast.data() + i);

        // The means of the two upper and the two lower rows belong to places two pixels apart, and
        // so do the columns left and right.
        const L b0 = at(batch.brightness[0]);
        const L b1 = at(batch.brightness[1]);
        const L b2 = at(batch.brightness[2]);
        const L b3 = at(batch.brightness[3]);
        ratio(b2 + b3 - b0 - b1, b0 + b1 + b2 + b3).store(batch.gradient_y.data() + i);
        const L left = at(batch.brightness_left);
        const L right = at(batch.brightness_right);
        ratio(right - left, left + right).store(batch.gradient_x.data() + i);
        const L brightness = (b1 + b2) * L(0.125f / frames);
        const L gain = ratio(brightness, contrast);
        select(d1 < d2, gain, L(0.0f) - gain).store(batch.drift_gain.data() + i);
    }
}

template <typename Lanes>
FACESCAN_KERNEL void layEdges(const EdgeBatch& batch, int first, int count,
                              const EdgeCells& cells) {
    static_assert(EdgeRun::kMost % Lanes::kCount == 0);
    using L = Lanes;
    for (int n = 0; n < EdgeRun::kMost; n += L::kCount) {
        const L contrast = L::load(batch.contrast.data() + first + n);
        const L there = L::load(cells.contrast + n);
        const auto measured = L::Mask::load(cells.measured + n);
        const auto stronger = (!measured) | (there < contrast);
        const auto take = stronger & (L::countFrom(float(n)) < L(float(count)));
        const auto lay = [&](const auto& column, float* plane) FACESCAN_INLINE_LAMBDA {
            select(take, L::load(column.data() + first + n), L::load(plane + n)).store(plane + n);
        };
        lay(batch.place, cells.y);
        lay(batch.contrast, cells.contrast);
        lay(batch.gradient_x, cells.gradient_x);
        lay(batch.gradient_y, cells.gradient_y);
        lay(batch.drift_gain, cells.drift_gain);
        (measured | take).store(cells.measured + n);
    }
}

}  // namespace facescan
