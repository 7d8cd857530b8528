#include "reconstruct/smooth.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/byte_group.h"
#include "reconstruct/grid_sample.h"
#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/median.h"

namespace facescan {
namespace {

/// Flags where a cell and its four neighbours are measured.
FACESCAN_KERNEL void markSurrounded(const std::uint8_t* __restrict above,
                                    const std::uint8_t* __restrict here,
                                    const std::uint8_t* __restrict below, int count,
                                    std::uint8_t* __restrict flags) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        flags[x] = here[x] & here[x - 1] & here[x + 1] & above[x] & below[x];
    }
}

/// Marks the cells that have their four neighbours and lie near the middle between them: a window
/// made of such cells alone has no jump and no outlier.
void markRegularCells(const VertexGrid& grid, const RegularityLimits& limits,
                      SmoothScratch& scratch) {
    const std::size_t columns = grid.columns;
    markMeasured(grid, scratch.measured);
    scratch.regular.assign(grid.size(), 0);
    for (int code = 1; code + 1 < grid.codes; ++code) {
        const int first = std::max(grid.extent[code].first, 1);
        const int end = std::min(grid.extent[code].end, grid.columns - 1);
        if (first >= end) continue;
        const std::size_t row = grid.index(code, 0);
        const std::uint8_t* m = scratch.measured.data() + row;
        std::uint8_t* regular = scratch.regular.data() + row;
        markSurrounded(m + first - columns, m + first, m + first + columns, end - first,
                       regular + first);
        const float* y = grid.y.data() + row;
        kernels().markRegular({y - columns, y, y + columns, grid.contrast.data() + row}, limits,
                              first, end, regular);
    }
}

/// Marks the cells whose whole window is regular.
void markCovered(const VertexGrid& grid, const Window& window,
                 const std::vector<std::uint8_t>& regular, std::vector<std::uint8_t>& row,
                 std::vector<std::uint8_t>& covered) {
    const int reach = window.half_columns;
    covered.assign(grid.size(), 0);
    row.resize(grid.columns);
    constexpr int kMostRows = 2 * kWindows.back().half_codes + 1;
    std::array<const std::uint8_t*, kMostRows> rows{};
    for (int code = window.half_codes + 1; code + window.half_codes < grid.codes; ++code) {
        const Extent& extent = grid.extent[code];
        const int first = std::max(extent.first, reach);
        const int end = std::min(extent.end, grid.columns - reach);
        if (first >= end) continue;
        const int count = 2 * window.half_codes + 1;
        for (int r = 0; r < count; ++r) {
            rows[r] = regular.data() + grid.index(code - window.half_codes + r, first - reach);
        }
        kernels().keepCommon(rows.data(), count, end - first + 2 * reach,
                             row.data() + first - reach);
        kernels().keepSurrounded(row.data(), reach, first, end,
                                 covered.data() + grid.index(code, 0));
    }
}

/// The limits of what noise explains.
class NoiseLimits {
public:
    NoiseLimits(const Options& options, const EdgeNoise& noise)
        : noise_(noise),
          sigmas_(float(options.outlier_sigmas)),
          floor_px_(float(options.noise_floor_px)),
          largest_px_(float(options.max_residual_px)) {}

    RegularityLimits regularity() const {
        return {sigmas_ * floor_px_, sigmas_ * noise_.grey_levels};
    }
    float noiseGreyLevels() const { return noise_.grey_levels; }
    float noisePx(float contrast) const { return noise_.pixels(contrast); }
    float cutoffPx(float contrast) const {
        return std::min(largest_px_, sigmas_ * std::max(floor_px_, noisePx(contrast)));
    }

private:
    EdgeNoise noise_;
    float sigmas_;
    float floor_px_;
    float largest_px_;
};

using WindowCounts = std::array<int, kWindows.size()>;

/// Flags by window the measured cells that the window which serves for them covers, and in `rest`
/// the other measured cells.
FACESCAN_KERNEL WindowCounts sortCells(
    const std::array<const std::uint8_t*, kWindows.size()>& covered,
    const std::uint8_t* __restrict measured, const std::uint8_t* __restrict window_of, int count,
    const std::array<std::uint8_t*, kWindows.size()>& filtered, std::uint8_t* __restrict rest) {
    WindowCounts counts{};
    std::copy_n(measured, count, rest);
    for (int window = 0; window < int(counts.size()); ++window) {
        const std::uint8_t* __restrict of_window = covered[window];
        std::uint8_t* __restrict to = filtered[window];
        const auto wanted = std::uint8_t(window);
#pragma GCC ivdep
        for (int x = 0; x < count; ++x) {
            to[x] = of_window[x] & measured[x] & std::uint8_t(window_of[x] == wanted ? 1 : 0);
            rest[x] ^= to[x];
        }
        int sum = 0;
        for (int x = 0; x < count; ++x) sum += to[x];
        counts[window] = sum;
    }
    return counts;
}

/// Smooths the cells for which a window's fixed filter serves, and lists the other measured cells
/// by window.
class RegularFilter {
public:
    RegularFilter(const VertexGrid& grid, const NoiseLimits& limits, SmoothScratch& scratch)
        : grid_(grid), limits_(limits), scratch_(scratch) {
        for (auto& requests : scratch.irregular) requests.clear();
        for (auto& row : scratch.column_sums) row.resize(grid.columns);
        for (auto& row : scratch.wanted) row.resize(grid.columns);
        scratch.window_of.resize(grid.columns);
        scratch.row.resize(grid.columns + ByteGroup::kSize);
    }

    void filterRow(int code, std::vector<float>& smoothed) {
        const auto [first, end] = grid_.extent[code];
        if (first >= end) return;
        const std::size_t row = grid_.index(code, 0);
        const std::size_t i = row + first;
        std::uint8_t* window_of = scratch_.window_of.data();
        std::uint8_t* rest = scratch_.row.data();
        auto& wanted = scratch_.wanted;
        kernels().chooseWindows(&grid_.contrast[i], limits_.noiseGreyLevels(), end - first,
                                window_of + first);
        const WindowCounts counts =
            sortCells({&scratch_.covered[0][i], &scratch_.covered[1][i], &scratch_.covered[2][i]},
                      &scratch_.measured[i], window_of + first, end - first,
                      {&wanted[0][first], &wanted[1][first], &wanted[2][first]}, rest + first);
        for (int window = 0; window < int(kWindows.size()); ++window) {
            if (counts[window] == 0) continue;
            // Nearer to the border no window is covered.
            const int reach = kWindows[window].half_columns;
            kernels().filterRow({&grid_.y[row],
                                 grid_.columns,
                                 wanted[window].data(),
                                 {scratch_.column_sums[0].data(), scratch_.column_sums[1].data()},
                                 &smoothed[row]},
                                fixedFilter(window), std::max(first, reach),
                                std::min(end, grid_.columns - reach));
        }
        forEachMatch(rest, first, end, 1, [&](int x) {
            scratch_.irregular[window_of[x]].push_back(
                {std::uint16_t(code), std::uint16_t(x), limits_.cutoffPx(grid_.contrast[row + x])});
        });
    }

private:
    const VertexGrid& grid_;
    const NoiseLimits& limits_;
    SmoothScratch& scratch_;
};

}  // namespace

EdgeNoise estimateNoise(const VertexGrid& grid, std::vector<float>& scratch) {
    // The third difference of independent values of variance 1 has the variance 1 + 9 + 9 + 1; the
    // median of a normal variable's modulus is 0.6745 standard deviations.
    constexpr float kMedianToSigma = 1.0f / (0.6745f * 4.4721f);
    scratch.clear();
    const std::size_t row = grid.columns;
    forEachSample(grid, 3, [&](std::size_t i) {
        const bool complete = grid.cell[i + row] == Cell::measured &&
                              grid.cell[i + 2 * row] == Cell::measured &&
                              grid.cell[i + 3 * row] == Cell::measured;
        if (!complete) return;
        const float third =
            grid.y[i + 3 * row] - grid.y[i] - 3 * (grid.y[i + 2 * row] - grid.y[i + row]);
        scratch.push_back(std::fabs(third) * 0.5f *
                          (grid.contrast[i + row] + grid.contrast[i + 2 * row]));
    });
    return {medianOf(scratch) * kMedianToSigma};
}

int smoothEdges(const Options& options, const EdgeNoise& noise, SmoothScratch& scratch,
                VertexGrid& grid) {
    const NoiseLimits limits(options, noise);
    markRegularCells(grid, limits.regularity(), scratch);
    for (std::size_t window = 0; window < kWindows.size(); ++window) {
        markCovered(grid, kWindows[window], scratch.regular, scratch.row, scratch.covered[window]);
    }
    scratch.planes.assign(grid);
    RegularFilter filter(grid, limits, scratch);
    for (int code = 1; code < grid.codes; ++code) filter.filterRow(code, grid.scratch);

    int emptied = 0;
    // All fits read the grid as it was; false measurements leave it at the end.
    const auto settle = [&](const FitRequest& request, const RobustFit& fit) {
        const std::size_t i = grid.index(request.code, request.column);
        grid.scratch[i] = fit.y;
        if (fit.consistent) return;
        scratch.measured[i] = 0;
        ++emptied;
    };
    for (std::size_t window = 0; window < kWindows.size(); ++window) {
        const std::vector<FitRequest>& requests = scratch.irregular[window];
        scratch.fits.resize(requests.size());
        robustFits(scratch.planes, int(window), kWindows[window].half_codes, requests,
                   scratch.fits);
        scratch.own_row.clear();
        for (std::size_t n = 0; n < requests.size(); ++n) {
            constexpr float kLittleNoise = 0.15f;  // px
            const std::size_t i = grid.index(requests[n].code, requests[n].column);
            const float noise_px = limits.noisePx(grid.contrast[i]);
            if (!scratch.fits[n].consistent && noise_px <= kLittleNoise) {
                // A crease is no surface for the window, but one for the vertex' own row: a vertex
                // with little noise is kept for that.
                scratch.own_row.push_back(requests[n]);
            } else {
                settle(requests[n], scratch.fits[n]);
            }
        }
        scratch.fits.resize(scratch.own_row.size());
        robustFits(scratch.planes, int(window), 0, scratch.own_row, scratch.fits);
        for (std::size_t n = 0; n < scratch.own_row.size(); ++n) {
            settle(scratch.own_row[n], scratch.fits[n]);
        }
    }
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (!scratch.measured[i]) grid.cell[i] = Cell::empty;
    }
    grid.y.swap(grid.scratch);
    return emptied;
}

}  // namespace facescan
