#pragma once

#include <cstdint>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"

namespace facescan {

template <typename Lanes>
FACESCAN_KERNEL void deviceRow(const DeviceRow& d, const EdgeRow& row, int count,
                               const PointRow& points) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        const L across = L::load(row.across + i);
        const L along =
            (L::load(row.y + i) + L(row.shift) - L(row.along_offset)) * L(row.along_per_px);
        const L x = L(d.ray_x[0]) * across + L(d.ray_x[1]) * along + L(d.ray_x[2]);
        const L y = L(d.ray_y[0]) * across + L(d.ray_y[1]) * along + L(d.ray_y[2]);
        const L r2 = x * x + y * y;
        const L stretch =
            L(1.0f) + r2 * (L(d.radial[0]) + r2 * (L(d.radial[1]) + r2 * L(d.radial[2])));
        const L p1(d.tangential[0]);
        const L p2(d.tangential[1]);
        const L xy = L(2.0f) * x * y;
        const L ray_x = x * stretch + p1 * xy + p2 * (r2 + L(2.0f) * x * x);
        const L ray_y = y * stretch + p1 * (r2 + L(2.0f) * y * y) + p2 * xy;
        const L plane = L(d.plane[0]) * ray_x + L(d.plane[1]) * ray_y + L(d.plane[2]);
        const L z = L(d.plane_distance) * reciprocal(plane);
        (ray_x * z).store(points.x + i);
        (ray_y * z).store(points.y + i);
        z.store(points.z + i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void polynomialRow(const PolynomialRow& p, const EdgeRow& row, int count,
                                   const PointRow& points) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        const L along =
            (L::load(row.y + i) + L(row.shift) - L(row.along_offset)) * L(row.along_per_px);
        const L code(p.code);
        float* const outputs[3] = {points.x, points.y, points.z};
        for (int output = 0; output < 3; ++output) {
            const float* term = p.terms + output * p.output_stride + i;
            // The terms lie by power of y, and for each from the highest power of the code down.
            L sum(0.0f);
            for (int j = p.degree; j >= 0; --j) {
                L coefficient(0.0f);
                for (int k = p.degree - j; k >= 0; --k, term += p.term_stride) {
                    coefficient = coefficient * code + L::load(term);
                }
                sum = sum * along + coefficient;
            }
            sum.store(outputs[output] + i);
        }
    });
}

/// Marks what lies in the range.
template <typename Lanes>
FACESCAN_KERNEL void markInRange(const float* z, float nearest, float farthest, int count,
                                 std::uint8_t* inside) {
    forLanes<Lanes>(0, count, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const L depth = L::load(z + x);
        ((L(nearest) <= depth) & (depth <= L(farthest))).store(inside + x);
    });
}

}  // namespace facescan
