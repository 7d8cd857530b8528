#pragma once

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"

namespace facescan {

template <typename Lanes>
FACESCAN_KERNEL void compareNeighbours(const float* y, const float* next_row,
                                       const ContinuityLimits& limits, int first, int end,
                                       const NeighbourRow& near) {
    forLanes<Lanes>(first, end, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const L here = L::load(y + x);
        for (int gap = 1; gap <= kLargestGap; ++gap) {
            const L step = abs(L::load(y + x + gap) - here);
            (step <= L(float(gap) * limits.max_step)).store(near.along[gap - 1] + x);
        }
        const L width = L(limits.sign) * (L::load(next_row + x) - here);
        ((L(limits.min_width) < width) & (width < L(limits.max_width))).store(near.across + x);
    });
}

}  // namespace facescan
