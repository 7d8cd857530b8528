#pragma once

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"

namespace facescan {

/// d / s, 0 where s is 0.
template <typename L>
FACESCAN_INLINE L ratio(L d, L s) {
    return select(L(0.0f) < s, d * reciprocal(s), L(0.0f));
}

template <typename Lanes>
FACESCAN_KERNEL void locateEdges(EdgeBatch& batch, float frames) {
    forLanes<Lanes>(0, batch.count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
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
        select(agree, four, inner).store(batch.place.data() + i);

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
    });
}

}  // namespace facescan
