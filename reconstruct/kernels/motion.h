#pragma once

#include <algorithm>
#include <array>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"

namespace facescan {

template <typename L>
struct Vector3 {
    L x, y, z;

    static FACESCAN_INLINE Vector3 load(const ConstPointRow& row, int i) {
        return {L::load(row.x + i), L::load(row.y + i), L::load(row.z + i)};
    }
    FACESCAN_INLINE void store(const PointRow& row, int i) const {
        x.store(row.x + i);
        y.store(row.y + i);
        z.store(row.z + i);
    }
    friend FACESCAN_INLINE Vector3 operator+(const Vector3& a, const Vector3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend FACESCAN_INLINE Vector3 operator-(const Vector3& a, const Vector3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend FACESCAN_INLINE Vector3 operator*(const Vector3& a, L b) {
        return {a.x * b, a.y * b, a.z * b};
    }
    friend FACESCAN_INLINE L dot(const Vector3& a, const Vector3& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    friend FACESCAN_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
};

template <typename Lanes>
FACESCAN_KERNEL void referencePlanes(const ReferenceRows& rows, int count,
                                     const ReferencePlaneRow& planes) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        using Vector = Vector3<L>;
        const Vector above_left = Vector::load(rows.above, i - rows.reach);
        const Vector above_right = Vector::load(rows.above, i + rows.reach);
        const Vector below_left = Vector::load(rows.below, i - rows.reach);
        const Vector below_right = Vector::load(rows.below, i + rows.reach);
        const Vector along = (above_right - above_left) + (below_right - below_left);
        const Vector across = (Vector::load(rows.below, i) - Vector::load(rows.above, i)) +
                              (below_right - above_right) + (below_left - above_left);
        const Vector normal = cross(along, across);
        const L square = dot(normal, normal);
        constexpr float kSmallest = 1e-20f;
        const auto exists = L(kSmallest) < square;
        const Vector unit = normal * inverseRoot(select(exists, square, L(1.0f)));
        const L mm_per_px = dot(unit, Vector::load(rows.ahead, i) - Vector::load(rows.here, i));
        unit.store(planes.normal, i);
        mm_per_px.store(planes.mm_per_px + i);
        const auto frontal = L(rows.least_mm_per_px) < abs(mm_per_px);

        const L above_y = L::load(rows.above_y + i);
        const L below_y = L::load(rows.below_y + i);
        const auto distance = [&](L a, const float* row,
                                  const std::uint8_t* measured) FACESCAN_INLINE_LAMBDA {
            constexpr float kFar = 1e9f;
            return select(L::Mask::load(measured + i), abs(a - L::load(row + i)), L(kFar));
        };
        const L beyond = largerOf(distance(above_y, rows.beyond_above_y, rows.beyond_above),
                                  distance(below_y, rows.beyond_below_y, rows.beyond_below));
        const auto passes = abs(above_y - below_y) <= L(rows.largest_jump) * beyond;
        const auto straight = [&](const float* y, L middle) FACESCAN_INLINE_LAMBDA {
            const L bend =
                L(2.0f) * middle - L::load(y + i - rows.reach) - L::load(y + i + rows.reach);
            return abs(bend) < L(rows.largest_bend);
        };
        (L::Mask::load(planes.known + i) & exists & frontal & passes &
         straight(rows.above_y, above_y) & straight(rows.below_y, below_y))
            .store(planes.known + i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void compensateRow(const ConstPointRow& points,
                                   const ConstReferencePlaneRow& planes, const MotionAbout& motion,
                                   int count, float* shift) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        using Vector = Vector3<L>;
        const auto all = [](const std::array<float, 3>& v) FACESCAN_INLINE_LAMBDA {
            return Vector{L(v[0]), L(v[1]), L(v[2])};
        };
        const Vector lever = Vector::load(points, i) - all(motion.centre);
        const Vector moved = all(motion.translation) + cross(all(motion.rotation), lever);
        const L mm = dot(Vector::load(planes.normal, i), moved);
        const auto known = L::Mask::load(planes.known + i);
        const L per_px = select(known, L::load(planes.mm_per_px + i), L(1.0f));
        (mm * reciprocal(per_px)).store(shift + i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void correctBias(const EdgeLightRow& row, const BiasModel& model, int count,
                                 float* corrected) {
    forLanes<Lanes>(0, count, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        constexpr float kSteepest = 3;
        constexpr float kLargestShift = 0.5f;  // px; beyond it the model does not hold
        const L zero(0.0f);
        const L y = L::load(row.y + x);
        const auto left = L::Mask::load(row.measured + x - 1);
        const auto right = L::Mask::load(row.measured + x + 1);
        const L rise = select(left, y - L::load(row.y + x - 1), zero) +
                       select(right, L::load(row.y + x + 1) - y, zero);
        const L slope = rise * select(left & right, L(0.5f), L(1.0f));
        const L gentle = select(abs(slope) < L(kSteepest), slope, zero);

        const L gradient_x = L::load(row.gradient_x + x);
        const L gradient_y = L::load(row.gradient_y + x);
        const L blur = L(model.variance) * (gradient_y - gradient_x * gentle);
        const L change = L(model.drift_column) * gradient_x + L(model.drift_y) * gradient_y;
        const L shift = blur + L::load(row.drift_gain + x) * change;
        const L bounded = smallerOf(largerOf(shift, L(-kLargestShift)), L(kLargestShift));
        (y + bounded).store(corrected + x);
    });
}

/// Adds up weighted equations row · unknowns = value, and the moduli of their residuals.
template <typename L>
class SixEquations {
public:
    FACESCAN_INLINE SixEquations() {
        for (L& sum : products_) sum = L(0.0f);
        for (L& sum : right_) sum = L(0.0f);
        residuals_ = L(0.0f);
    }

    FACESCAN_INLINE void add(const L (&row)[6], L value, L weight, L residual) {
        int n = 0;
        for (int i = 0; i < 6; ++i) {
            const L weighted = weight * row[i];
            for (int j = 0; j <= i; ++j, ++n) products_[n] = products_[n] + weighted * row[j];
            right_[i] = right_[i] + weighted * value;
        }
        residuals_ = residuals_ + residual;
    }

    /// Leaves the lanes' sums in columns `lane` and on of a table.
    FACESCAN_INLINE void store(float (&table)[28][kSumLanes], int lane) const {
        for (int n = 0; n < 21; ++n) products_[n].store(&table[n][lane]);
        for (int n = 0; n < 6; ++n) right_[n].store(&table[21 + n][lane]);
        residuals_.store(&table[27][lane]);
    }

private:
    L products_[21];
    L right_[6];
    L residuals_;
};

/// Sums over items 0 … count − 1 in kSumLanes lanes, and the lanes in their order.
/// observe<L>(i, equations) adds the items from i on.
template <typename Lanes, typename Observe>
FACESCAN_INLINE void sumSix(int count, SixSums& sums, Observe observe) {
    float table[28][kSumLanes];
    for (int lane = 0; lane < kSumLanes; lane += Lanes::kCount) {
        SixEquations<Lanes> equations;
        for (int i = lane; i < count; i += kSumLanes) observe(i, equations);
        equations.store(table, lane);
    }
    const auto total = [&](int n) {
        float sum = 0;
        for (const float lane : table[n]) sum += lane;
        return sum;
    };
    for (int n = 0; n < 21; ++n) sums.products[n] = total(n);
    for (int n = 0; n < 6; ++n) sums.right[n] = total(21 + n);
    sums.residuals = total(27);
}

/// Tukey's biweight.
template <typename L>
FACESCAN_INLINE L biweight(L residual, float inverse_cutoff) {
    const L u = residual * L(inverse_cutoff);
    const L bell = largerOf(L(1.0f) - u * u, L(0.0f));
    return bell * bell;
}

template <typename Lanes>
FACESCAN_KERNEL void sumAlignment(const AlignmentBatch& batch, const std::array<float, 6>& motion,
                                  float inverse_cutoff, SixSums& sums) {
    using L = Lanes;
    sumSix<L>(batch.count, sums, [&](int i, SixEquations<L>& equations) FACESCAN_INLINE_LAMBDA {
        L row[6];
        L predicted(0.0f);
        for (int k = 0; k < 6; ++k) {
            row[k] = L::load(batch.row[k] + i);
            predicted = predicted + row[k] * L(motion[k]);
        }
        const L distance = L::load(batch.distance + i);
        const L residual = abs(distance - predicted);
        equations.add(row, distance, biweight(residual, inverse_cutoff), residual);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void warpPixels(const RegistrationPixels& pixels, const Similarity& m,
                                const WarpedPixels& warped) {
    forLanes<Lanes>(0, pixels.count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        const L lever_x = L::load(pixels.lever_x + i);
        const L lever_y = L::load(pixels.lever_y + i);
        const L stretch(1.0f + m.scale);
        const L x = L(m.middle_x + m.x) + stretch * lever_x - L(m.turn) * lever_y;
        const L y = L(m.middle_y + m.y) + stretch * lever_y + L(m.turn) * lever_x;
        const auto inside = (L(0.0f) <= x) & (x < L(m.last_x)) & (L(0.0f) <= y) & (y < L(m.last_y));
        const L safe_x = select(inside, x, L(0.0f));
        const L safe_y = select(inside, y, L(0.0f));
        safe_x.store(warped.x + i);
        safe_y.store(warped.y + i);
        (safe_x - L::load(warped.x + i)).store(warped.part_x + i);
        (safe_y - L::load(warped.y + i)).store(warped.part_y + i);
        select(inside, L(1.0f), L(0.0f)).store(warped.weight + i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void sumRegistration(const RegistrationPixels& pixels, const WarpedPixels& warped,
                                     const RegistrationState& state, SixSums& sums) {
    using L = Lanes;
    sumSix<L>(pixels.count, sums, [&](int i, SixEquations<L>& equations) FACESCAN_INLINE_LAMBDA {
        const L part_x = L::load(warped.part_x + i);
        const L part_y = L::load(warped.part_y + i);
        const L upper = L::load(warped.level[0] + i);
        const L lower = L::load(warped.level[2] + i);
        const L top = upper + part_x * (L::load(warped.level[1] + i) - upper);
        const L bottom = lower + part_x * (L::load(warped.level[3] + i) - lower);
        const L value = L(state.unit) * (top + part_y * (bottom - top));

        const L gain(state.gain);
        const L level = L::load(pixels.level + i);
        const L gradient_x = gain * L::load(pixels.gradient_x + i);
        const L gradient_y = gain * L::load(pixels.gradient_y + i);
        const L lever_x = L(state.per_lever) * L::load(pixels.lever_x + i);
        const L lever_y = L(state.per_lever) * L::load(pixels.lever_y + i);
        const L row[6] = {gradient_x,
                          gradient_y,
                          gradient_y * lever_x - gradient_x * lever_y,
                          gradient_x * lever_x + gradient_y * lever_y,
                          L(0.0f) - level,
                          L(-1.0f)};
        const L residual = value - gain * level - L(state.offset);
        const L weight = L::load(warped.weight + i);
        equations.add(row, L(0.0f) - residual, weight * biweight(residual, state.inverse_cutoff),
                      weight * abs(residual));
    });
}

/// @param rows  two rows of a pattern's frame, two of its complement's
template <typename Form>
FACESCAN_KERNEL void halveRows(const std::array<const std::uint8_t*, 4>& rows, int width,
                               std::uint16_t* __restrict halved) {
    const std::uint8_t* __restrict a = rows[0];
    const std::uint8_t* __restrict b = rows[1];
    const std::uint8_t* __restrict c = rows[2];
    const std::uint8_t* __restrict d = rows[3];
#pragma GCC ivdep
    for (int x = 0; x < width; ++x) {
        halved[x] = std::uint16_t((a[2 * x] + a[2 * x + 1]) + (b[2 * x] + b[2 * x + 1]) +
                                  (c[2 * x] + c[2 * x + 1]) + (d[2 * x] + d[2 * x + 1]));
    }
}

/// Weights 1 2 1 along both axes; beyond the ends of a row its last pixels count again.
template <typename Form>
FACESCAN_KERNEL void blurRows(const std::array<const std::uint16_t*, 3>& rows, int width,
                              std::uint16_t* __restrict blurred) {
    const std::uint16_t* __restrict above = rows[0];
    const std::uint16_t* __restrict here = rows[1];
    const std::uint16_t* __restrict below = rows[2];
    const auto down = [&](int x)
                          FACESCAN_INLINE_LAMBDA { return above[x] + 2 * here[x] + below[x]; };
    blurred[0] = std::uint16_t(3 * down(0) + down(std::min(1, width - 1)));
#pragma GCC ivdep
    for (int x = 1; x < width - 1; ++x) {
        blurred[x] = std::uint16_t(down(x - 1) + 2 * down(x) + down(x + 1));
    }
    blurred[width - 1] = std::uint16_t(3 * down(width - 1) + down(std::max(width - 2, 0)));
}

}  // namespace facescan
