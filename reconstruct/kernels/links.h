#pragma once

#include <cstdint>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"

namespace facescan {

template <typename Lanes>
FACESCAN_KERNEL void linkNeighbours(const LinkedRows& rows, const ContinuityLimits& limits,
                                    int first, int end, const RowLinks& links) {
    forLanes<Lanes>(first, end, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const L here = L::load(rows.y + x);
        auto open = L::Mask::load(rows.measured + x);
        const L width = L(limits.sign) * (L::load(rows.next_y + x) - here);
        (open & L::Mask::load(rows.next_measured + x) & (L(limits.min_width) < width) &
         (width < L(limits.max_width)))
            .store(links.across + x);
        // The next cell counts, and no other beyond it.
        for (int gap = 1; gap <= kLargestGap; ++gap) {
            const auto there = L::Mask::load(rows.measured + x + gap);
            const L step = abs(L::load(rows.y + x + gap) - here);
            (open & there & (step <= L(float(gap) * limits.max_step)))
                .store(links.along[gap - 1] + x);
            open = open & !there;
        }
    });
}

/// Counts the marks of what continues each cell, and those that begin at it.
template <typename Form>
FACESCAN_KERNEL int rejectUnsupported(const RowLinks& links,
                                      const std::uint8_t* __restrict from_before,
                                      const std::uint8_t* __restrict measured, int first, int end,
                                      std::uint8_t* __restrict kept) {
    const std::uint8_t* __restrict next1 = links.along[0];
    const std::uint8_t* __restrict next2 = links.along[1];
    const std::uint8_t* __restrict next3 = links.along[2];
    const std::uint8_t* __restrict across = links.across;
#pragma GCC ivdep
    for (int x = first; x < end; ++x) {
        const std::uint8_t support =
            std::uint8_t(next1[x] + next2[x] + next3[x] + next1[x - 1] + next2[x - 2] +
                         next3[x - 3] + across[x] + from_before[x]);
        kept[x] = measured[x] & std::uint8_t(support >= 2 ? 1 : 0);
    }
    int rejected = 0;
    for (int x = first; x < end; ++x) rejected += measured[x] ^ kept[x];
    return rejected;
}

}  // namespace facescan
