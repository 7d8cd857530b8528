#include "reconstruct/smooth.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/median.h"

namespace facescan {
namespace {

/// Leaves a flag only where the other one is.
FACESCAN_KERNEL void keepCommon(const std::uint8_t* __restrict other, int count,
                                std::uint8_t* __restrict flags) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) flags[x] &= other[x];
}

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
    const int count = grid.columns - 2 * reach;
    covered.assign(grid.size(), 0);
    if (count <= 0) return;
    row.resize(grid.columns);
    for (int code = window.half_codes + 1; code + window.half_codes < grid.codes; ++code) {
        const Extent& extent = grid.extent[code];
        const int first = std::max(extent.first, reach);
        const int end = std::min(extent.end, grid.columns - reach);
        if (first >= end) continue;
        // Down the window's columns first, then along its rows.
        std::fill(row.begin() + first - reach, row.begin() + end + reach, std::uint8_t(1));
        for (int c = code - window.half_codes; c <= code + window.half_codes; ++c) {
            keepCommon(regular.data() + grid.index(c, first - reach), end - first + 2 * reach,
                       row.data() + first - reach);
        }
        std::uint8_t* out = covered.data() + grid.index(code, 0);
        std::fill(out + first, out + end, std::uint8_t(1));
        for (int dx = -reach; dx <= reach; ++dx) {
            keepCommon(row.data() + first + dx, end - first, out + first);
        }
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

/// Flags the measured cells that the window which serves for them covers, and counts them.
FACESCAN_KERNEL WindowCounts
markRegular(const std::array<const std::uint8_t*, kWindows.size()>& covered,
            const std::uint8_t* __restrict measured, const std::uint8_t* __restrict window_of,
            int count, std::uint8_t* __restrict regular) {
    const std::uint8_t* __restrict narrow = covered[0];
    const std::uint8_t* __restrict middle = covered[1];
    const std::uint8_t* __restrict wide = covered[2];
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        const std::uint8_t wider = window_of[x] == 1 ? middle[x] : wide[x];
        regular[x] = (window_of[x] == 0 ? narrow[x] : wider) & measured[x];
    }
    WindowCounts wanted{};
    for (int window = 0; window < int(wanted.size()); ++window) {
        int sum = 0;
        for (int x = 0; x < count; ++x) sum += regular[x] & (window_of[x] == window);
        wanted[window] = sum;
    }
    return wanted;
}

/// Takes what a window's filter made of a row where the window is the cells' own.
FACESCAN_KERNEL void takeFiltered(const std::uint8_t* __restrict window_of,
                                  const std::uint8_t* __restrict regular, int window,
                                  const float* __restrict filtered, int count,
                                  float* __restrict smoothed) {
    for (int x = 0; x < count; ++x) {
        const bool take = regular[x] && window_of[x] == window;
        smoothed[x] = take ? filtered[x] : smoothed[x];
    }
}

/// Smooths the cells for which a window's fixed filter serves, and lists the other measured cells
/// by window.
class RegularFilter {
public:
    RegularFilter(const VertexGrid& grid, const NoiseLimits& limits, SmoothScratch& scratch)
        : grid_(grid), limits_(limits), scratch_(scratch) {
        for (auto& requests : scratch.irregular) requests.clear();
        scratch.filtered.resize(grid.columns);
        scratch.window_of.resize(grid.columns);
        scratch.row.resize(grid.columns);
    }

    void filterRow(int code, std::vector<float>& smoothed) {
        const auto [first, end] = grid_.extent[code];
        const int count = end - first;
        if (count <= 0) return;
        const std::size_t i = grid_.index(code, first);
        std::uint8_t* window_of = scratch_.window_of.data();
        std::uint8_t* regular = scratch_.row.data();
        kernels().chooseWindows(&grid_.contrast[i], limits_.noiseGreyLevels(), count, window_of);
        const std::uint8_t* measured = &scratch_.measured[i];
        const WindowCounts wanted =
            markRegular({&scratch_.covered[0][i], &scratch_.covered[1][i], &scratch_.covered[2][i]},
                        measured, window_of, count, regular);
        for (int window = 0; window < int(kWindows.size()); ++window) {
            if (wanted[window] == 0) continue;
            const Window& shape = kWindows[window];
            // Nearer to the border no window is covered.
            const int begin = std::max(shape.half_columns - first, 0);
            const int stop = std::min(count, grid_.columns - shape.half_columns - first);
            kernels().filterRow(&grid_.y[i], grid_.columns,
                                {shape.half_codes, shape.half_columns, fixedWeights(window).data()},
                                begin, stop, scratch_.filtered.data());
            takeFiltered(window_of, regular, window, scratch_.filtered.data(), count, &smoothed[i]);
        }
        for (int x = 0; x < count; ++x) {
            if (measured[x] == regular[x]) continue;
            scratch_.irregular[window_of[x]].push_back({std::uint16_t(code),
                                                        std::uint16_t(first + x),
                                                        limits_.cutoffPx(grid_.contrast[i + x])});
        }
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
    const int step = samplingStep(grid.size());
    for (int code = 1; code + 3 < grid.codes; ++code) {
        // Along a diagonal, so that every column has its samples.
        const int first = grid.extent[code].first;
        for (int column = first + code % step; column < grid.extent[code].end; column += step) {
            const std::size_t i = grid.index(code, column);
            const bool complete = grid.cell[i] == Cell::measured &&
                                  grid.cell[i + row] == Cell::measured &&
                                  grid.cell[i + 2 * row] == Cell::measured &&
                                  grid.cell[i + 3 * row] == Cell::measured;
            if (!complete) continue;
            const float third =
                grid.y[i + 3 * row] - grid.y[i] - 3 * (grid.y[i + 2 * row] - grid.y[i + row]);
            scratch.push_back(std::fabs(third) * 0.5f *
                              (grid.contrast[i + row] + grid.contrast[i + 2 * row]));
        }
    }
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
    grid.scratch = grid.y;
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
