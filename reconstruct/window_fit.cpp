#include "reconstruct/window_fit.h"

#include <algorithm>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

FixedFilter computeFixedFilter(const Window& window) {
    constexpr int kTerms = 6;  // 1, v, u, v u, u², v²: v along the codes, u along the columns
    const auto place = [](int n, int half) { return double(n) / half; };
    NormalEquations<double, kTerms> equations;
    for (int c = -window.half_codes; c <= window.half_codes; ++c) {
        for (int x = -window.half_columns; x <= window.half_columns; ++x) {
            const double v = place(c, window.half_codes);
            const double u = place(x, window.half_columns);
            equations.add({1, v, u, v * u, u * u, v * v}, 0, 1);
        }
    }
    // The value in the middle is the solution's first number: a row of the inverse times the sums
    // on the right. By symmetry only those with 1, u² and v² count.
    equations.addRight({1, 0, 0, 0, 0, 0}, 1);
    std::array<double, kTerms> inverse{};
    equations.solve(inverse);
    FixedFilter filter{window.half_codes, window.half_columns, {}, {}};
    for (int k = 0; k <= window.half_columns; ++k) {
        const double u = place(k, window.half_columns);
        filter.along[k] = float(inverse[0] + inverse[4] * u * u);
    }
    for (int r = 0; r <= window.half_codes; ++r) {
        const double v = place(r, window.half_codes);
        filter.across[r] = float(inverse[5] * v * v);
    }
    return filter;
}

FACESCAN_KERNEL void copyMeasured(const Cell* __restrict cell, const float* __restrict y, int count,
                                  float* __restrict to_y, float* __restrict present) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        to_y[x] = cell[x] == Cell::measured ? y[x] : 0.0f;
        present[x] = cell[x] == Cell::measured ? 1.0f : 0.0f;
    }
}

constexpr int kMarginCodes = kWindows.back().half_codes;
constexpr int kMarginColumns = kWindows.back().half_columns;
/// A span that starts at the last column reads as many columns beyond it.
constexpr int kBeyond = FitSpan::kSize;

}  // namespace

const FixedFilter& fixedFilter(int window) {
    static const std::array<FixedFilter, kWindows.size()> table{computeFixedFilter(kWindows[0]),
                                                                computeFixedFilter(kWindows[1]),
                                                                computeFixedFilter(kWindows[2])};
    return table[window];
}

void FitPlanes::assign(const VertexGrid& grid) {
    const std::ptrdiff_t row_length = grid.columns + 2 * kMarginColumns + kBeyond;
    const std::size_t size = row_length * (grid.codes + 2 * kMarginCodes) + kBeyond;
    if (stride != row_length || y.size() != size) {
        stride = row_length;
        y.assign(size, 0.0f);
        present.assign(size, 0.0f);
        written.assign(grid.codes, {});
    }
    for (int code = 1; code < grid.codes; ++code) {
        // What the grid before left elsewhere goes too.
        Extent extent = grid.extent[code];
        Extent& before = written[code];
        if (extent.first >= extent.end) extent = before;
        if (before.first < before.end) {
            extent = {std::min(extent.first, before.first), std::max(extent.end, before.end)};
        }
        before = grid.extent[code];
        if (extent.first >= extent.end) continue;
        const std::size_t i = grid.index(code, extent.first);
        copyMeasured(&grid.cell[i], &grid.y[i], extent.end - extent.first,
                     &y[index(code, extent.first)], &present[index(code, extent.first)]);
    }
}

std::ptrdiff_t FitPlanes::index(int code, int column) const {
    return (code + kMarginCodes) * stride + column + kMarginColumns;
}

void robustFits(const FitPlanes& planes, int window, int half_codes,
                std::span<const FitRequest> requests, std::span<RobustFit> fits) {
    constexpr float kFewestOfSurface = 8;
    constexpr float kFewestOfRow = 5;
    FitSpan span;
    span.setWindow(kWindows[window]);
    span.half_codes = half_codes;
    span.stride = planes.stride;
    span.fewest = half_codes > 0 ? kFewestOfSurface : kFewestOfRow;
    for (std::size_t first = 0; first < requests.size();) {
        const FitRequest& start = requests[first];
        span.y = planes.y.data() + planes.index(start.code, start.column);
        span.present = planes.present.data() + planes.index(start.code, start.column);
        span.wanted.fill(0);
        span.cutoff.fill(start.cutoff);
        std::size_t end = first;
        for (; end < requests.size() && requests[end].code == start.code &&
               requests[end].column < start.column + FitSpan::kSize;
             ++end) {
            const int lane = requests[end].column - start.column;
            span.wanted[lane] = 1;
            span.cutoff[lane] = requests[end].cutoff;
        }
        kernels().fitWindows(span);
        for (; first < end; ++first) {
            const int lane = requests[first].column - start.column;
            fits[first] = {span.y[lane] + span.correction[lane], span.consistent[lane] != 0};
        }
    }
}

}  // namespace facescan
