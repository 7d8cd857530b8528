#pragma once

#include <algorithm>
#include <cstdint>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"
#include "reconstruct/window.h"

namespace facescan {

/// Whether edges lie near the middle between their neighbours in the row and in the column.
template <typename Lanes>
FACESCAN_KERNEL void markRegular(const RegularityRows& rows, const RegularityLimits& limits,
                                 int first, int end, std::uint8_t* regular) {
    forLanes<Lanes>(first, end, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const L twice = L(2.0f) * L::load(rows.here + x);
        const L along = twice - L::load(rows.here + x - 1) - L::load(rows.here + x + 1);
        const L across = twice - L::load(rows.before + x) - L::load(rows.after + x);
        const L contrast = L::load(rows.contrast + x);
        const L limit =
            L(2.0f) * largerOf(L(limits.tolerance_px) * contrast, L(limits.noise_grey_levels));
        const auto near = (abs(along) * contrast < limit) & (abs(across) * contrast < limit);
        (L::Mask::load(regular + x) & near).store(regular + x);
    });
}

/// The index of the window that serves for each cell's noise.
template <typename Lanes>
FACESCAN_KERNEL void chooseWindows(const float* contrast, float noise_grey_levels, int count,
                                   std::uint8_t* window) {
    forLanes<Lanes>(0, count, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const L c = L::load(contrast + x);
        const L noise(noise_grey_levels);
        L index(0.0f);
        for (std::size_t w = 0; w + 1 < kWindows.size(); ++w) {
            index = index + select(L(kWindows[w].max_noise_px) * c < noise, L(1.0f), L(0.0f));
        }
        std::int32_t indices[Lanes::kCount];
        index.store(indices);
        for (int n = 0; n < L::kCount; ++n) window[x + n] = std::uint8_t(indices[n]);
    });
}

template <typename Form>
FACESCAN_KERNEL void keepCommon(const std::uint8_t* const* rows, int count, int columns,
                                std::uint8_t* common) {
    std::copy_n(rows[0], columns, common);
    for (int r = 1; r < count; ++r) {
        const std::uint8_t* __restrict row = rows[r];
        std::uint8_t* __restrict to = common;
#pragma GCC ivdep
        for (int x = 0; x < columns; ++x) to[x] &= row[x];
    }
}

template <typename Form>
FACESCAN_KERNEL void keepSurrounded(const std::uint8_t* flags, int reach, int first, int end,
                                    std::uint8_t* common) {
    // Along 1, 2, 4 … columns at once; the last step overlaps the one before.
    constexpr int kChunk = 512;
    constexpr int kMostReach = 8;
    std::uint8_t memory[kChunk + 2 * kMostReach];
    for (int begin = first; begin < end; begin += kChunk) {
        const int count = std::min(kChunk, end - begin);
        const int width = 2 * reach + 1;
        int length = count + 2 * reach;
        std::copy_n(flags + begin - reach, length, memory);
        for (int covered = 1; covered < width;) {
            const int step = std::min(covered, width - covered);
            length -= step;
            std::uint8_t* row = memory;
            for (int x = 0; x < length; ++x) row[x] = row[x] & row[x + step];
            covered += step;
        }
        std::copy_n(memory, count, common + begin);
    }
}

template <typename Lanes>
FACESCAN_KERNEL void filterRow(const FilteredRow& row, const FixedFilter& filter, int first,
                               int end) {
    float* sums = row.scratch[0];
    float* bends = row.scratch[1];
    const int reach = filter.half_columns;
    // Down the columns: the sum, and the sum by the weights across the codes.
    forLanes<Lanes>(first - reach, end + reach, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const float* y = row.y + x;
        L sum = L::load(y);
        L bend(0.0f);
        for (int r = 1; r <= filter.half_codes; ++r) {
            const std::ptrdiff_t step = std::ptrdiff_t(r) * row.columns;
            const L both = L::load(y - step) + L::load(y + step);
            sum = sum + both;
            bend = bend + L(filter.across[r]) * both;
        }
        sum.store(sums + x);
        bend.store(bends + x);
    });
    forLanes<Lanes>(first, end, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const auto wanted = L::Mask::load(row.wanted + x);
        L result = L(filter.along[0]) * L::load(sums + x) + L::load(bends + x);
        for (int k = 1; k <= reach; ++k) {
            const L both = L::load(sums + x - k) + L::load(sums + x + k);
            result = result + L(filter.along[k]) * both + L::load(bends + x - k) +
                     L::load(bends + x + k);
        }
        select(wanted, result, L::load(row.filtered + x)).store(row.filtered + x);
    });
}

/// The quadratic a[0] + a[1] v + a[2] u + a[3] v u + a[4] u² + a[5] v² in places u along the
/// columns and v along the codes, for windows side by side.
template <typename L>
class WindowQuadratic {
public:
    /// Sums the normal equations of a row of windows at the place v.
    FACESCAN_INLINE void addRow(float v, const L (&w)[5], const L (&b)[3]) {
        const L v1(v);
        const L v2(v * v);
        const L v3(v * v * v);
        const L v4(v * v * v * v);
        add(0, 0, w[0]);
        add(1, 0, v1 * w[0]);
        add(1, 1, v2 * w[0]);
        add(2, 0, w[1]);
        add(2, 1, v1 * w[1]);
        add(2, 2, w[2]);
        add(3, 1, v2 * w[1]);
        add(3, 2, v1 * w[2]);
        add(3, 3, v2 * w[2]);
        add(4, 2, w[3]);
        add(4, 3, v1 * w[3]);
        add(4, 4, w[4]);
        add(5, 1, v3 * w[0]);
        add(5, 3, v3 * w[1]);
        add(5, 5, v4 * w[0]);
        right_[0] = right_[0] + b[0];
        right_[1] = right_[1] + v1 * b[0];
        right_[2] = right_[2] + b[1];
        right_[3] = right_[3] + v1 * b[1];
        right_[4] = right_[4] + b[2];
        right_[5] = right_[5] + v2 * b[0];
    }

    FACESCAN_INLINE WindowQuadratic() {
        for (int i = 0; i < kTerms; ++i) {
            for (int j = 0; j <= i; ++j) matrix_[i][j] = L(0.0f);
            right_[i] = L(0.0f);
        }
    }

    /// Solves by L D Lᵀ. @returns where the equations determine the quadratic
    FACESCAN_INLINE typename L::Mask solve(float damping, L (&a)[6]) {
        // Products that stand in the matrix twice.
        matrix_[3][0] = matrix_[2][1];
        matrix_[4][0] = matrix_[2][2];
        matrix_[4][1] = matrix_[3][2];
        matrix_[5][0] = matrix_[1][1];
        matrix_[5][2] = matrix_[3][1];
        matrix_[5][4] = matrix_[3][3];
        for (int i = 1; i < kTerms; ++i) matrix_[i][i] = matrix_[i][i] + L(damping);

        constexpr float kSingular = 4e-6f;  // of a diagonal element: rounding
        typename L::Mask determined = L(0.0f) < matrix_[0][0];
        L inverse[kTerms];
        L lower[kTerms][kTerms];
        for (int i = 0; i < kTerms; ++i) {
            L pivot = matrix_[i][i];
            L scaled[kTerms];
            for (int j = 0; j < i; ++j) {
                L sum = matrix_[i][j];
                for (int k = 0; k < j; ++k) sum = sum - scaled[k] * lower[j][k];
                scaled[j] = sum;
                lower[i][j] = sum * inverse[j];
                pivot = pivot - sum * lower[i][j];
            }
            const auto safe = L(kSingular) * matrix_[i][i] < pivot;
            determined = determined & safe;
            inverse[i] = reciprocal(select(safe, pivot, L(1.0f)));
        }
        for (int i = 0; i < kTerms; ++i) {
            a[i] = right_[i];
            for (int k = 0; k < i; ++k) a[i] = a[i] - lower[i][k] * a[k];
        }
        for (int i = kTerms - 1; i >= 0; --i) {
            a[i] = a[i] * inverse[i];
            for (int k = i + 1; k < kTerms; ++k) a[i] = a[i] - lower[k][i] * a[k];
        }
        return determined;
    }

private:
    static constexpr int kTerms = 6;

    FACESCAN_INLINE void add(int i, int j, L value) { matrix_[i][j] = matrix_[i][j] + value; }

    L matrix_[kTerms][kTerms];  ///< the lower triangle
    L right_[kTerms];
};

/// Fits the windows around neighbouring cells. The two cells of a row at the same distance from the
/// middle go together: sums of even powers of u take what they have in common, odd ones the rest.
template <typename L>
class WindowFitter {
public:
    FACESCAN_INLINE WindowFitter(const FitSpan& span, int lane)
        : span_(span),
          y_(span.y + lane),
          present_(span.present + lane),
          middle_(L::load(y_)),
          cutoff_(L::load(span.cutoff.data() + lane)),
          wanted_(L::Mask::load(span.wanted.data() + lane)) {}

    /// @param correction  the surface at the cell, px from the cell; 0 where it is not consistent
    /// @returns where the cell is consistent with the surface
    FACESCAN_INLINE typename L::Mask fit(L& correction) {
        const L fewest(span_.fewest);
        L cells(0.0f);
        int n = 0;
        for (int r = -span_.half_codes; r <= span_.half_codes; ++r) {
            const float* present = present_ + r * span_.stride;
            for (int k = -span_.half_columns; k <= span_.half_columns; ++k, ++n) {
                weight_[n] = L::load(present + k);
                cells = cells + weight_[n];
            }
        }
        auto possible = fewest <= cells;

        L a[6];
        possible = possible & solve(a);
        L largest(0.0f);
        const L support = reweigh(a, reciprocal(L(1.5f) * cutoff_), largest);
        // Nothing stands out: the unweighted fit is the best one.
        const auto plain = possible & (largest < L(0.5f) * cutoff_);
        const L plain_correction = a[0];
        if (!any(wanted_ & possible & !plain)) {
            correction = select(plain, plain_correction, L(0.0f));
            return plain;
        }
        possible = possible & solve(a);
        const auto consistent = plain | (possible & (fewest <= support) & (abs(a[0]) < cutoff_));
        correction = select(consistent, select(plain, plain_correction, a[0]), L(0.0f));
        return consistent;
    }

private:
    static FACESCAN_INLINE bool any(typename L::Mask m) {
        std::uint8_t bytes[8];
        m.store(bytes);
        int sum = 0;
        for (int n = 0; n < L::kCount; ++n) sum += bytes[n];
        return sum != 0;
    }

    FACESCAN_INLINE typename L::Mask solve(L (&a)[6]) {
        WindowQuadratic<L> quadratic;
        const int half = span_.half_columns;
        const L* middle_weight = weight_ + half;
        for (int r = -span_.half_codes; r <= span_.half_codes; ++r, middle_weight += 2 * half + 1) {
            const float* row = y_ + r * span_.stride;
            L w[5] = {*middle_weight, 0.0f, 0.0f, 0.0f, 0.0f};
            L b[3] = {*middle_weight * (L::load(row) - middle_), 0.0f, 0.0f};
            for (int k = 1; k <= half; ++k) {
                const L u(span_.places[k]);
                const L u2(span_.squares[k]);
                const L right = middle_weight[k];
                const L left = middle_weight[-k];
                const L even = right + left;
                const L odd = (right - left) * u;
                const L even_u2 = even * u2;
                w[0] = w[0] + even;
                w[1] = w[1] + odd;
                w[2] = w[2] + even_u2;
                w[3] = w[3] + odd * u2;
                w[4] = w[4] + even_u2 * u2;
                const L right_value = right * (L::load(row + k) - middle_);
                const L left_value = left * (L::load(row - k) - middle_);
                const L even_value = right_value + left_value;
                b[0] = b[0] + even_value;
                b[1] = b[1] + (right_value - left_value) * u;
                b[2] = b[2] + even_value * u2;
            }
            quadratic.addRow(float(r) * span_.per_code, w, b);
        }
        constexpr float kDamping = 1e-4f;
        return quadratic.solve(kDamping, a);
    }

    /// Tukey's biweight of the residuals.
    /// @param largest  the largest residual
    /// @returns the sum of the weights
    FACESCAN_INLINE L reweigh(const L (&a)[6], L inverse_cutoff, L& largest) {
        L support(0.0f);
        const int half = span_.half_columns;
        L* middle_weight = weight_ + half;
        for (int r = -span_.half_codes; r <= span_.half_codes; ++r, middle_weight += 2 * half + 1) {
            const L v(float(r) * span_.per_code);
            const L c0 = a[0] + v * (a[1] + v * a[5]) + middle_;
            const L c1 = a[2] + v * a[3];
            const float* y = y_ + r * span_.stride;
            const float* present = present_ + r * span_.stride;
            const auto weigh = [&](int k, L surface) FACESCAN_INLINE_LAMBDA {
                const L here = L::load(present + k);
                const L residual = L::load(y + k) - surface;
                const L scaled = residual * inverse_cutoff;
                const L bell = largerOf(L(1.0f) - scaled * scaled, L(0.0f));
                const L weight = bell * bell * here;
                middle_weight[k] = weight;
                support = support + weight;
                largest = largerOf(largest, abs(residual * here));
            };
            weigh(0, c0);
            for (int k = 1; k <= half; ++k) {
                const L even = c0 + L(span_.squares[k]) * a[4];
                const L odd = L(span_.places[k]) * c1;
                weigh(k, even + odd);
                weigh(-k, even - odd);
            }
        }
        return support;
    }

    const FitSpan& span_;
    const float* y_;
    const float* present_;
    L middle_;
    L cutoff_;
    typename L::Mask wanted_;
    L weight_[FitSpan::kMostCells];
};

template <typename Lanes>
FACESCAN_KERNEL void fitWindows(FitSpan& span) {
    static_assert(FitSpan::kSize % Lanes::kCount == 0);
    for (int lane = 0; lane < FitSpan::kSize; lane += Lanes::kCount) {
        int wanted = 0;
        for (int n = 0; n < Lanes::kCount; ++n) wanted += span.wanted[lane + n];
        if (wanted == 0) continue;
        WindowFitter<Lanes> fitter(span, lane);
        Lanes correction;
        fitter.fit(correction).store(span.consistent.data() + lane);
        correction.store(span.correction.data() + lane);
    }
}

}  // namespace facescan
