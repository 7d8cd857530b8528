#include "reconstruct/smooth.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "reconstruct/window_fit.h"

namespace facescan {
namespace {

/// Whether a cell has its four neighbours and lies near the middle between them: a patch made of
/// such cells alone has no jump and no outlier.
bool isRegular(const VertexGrid& grid, std::size_t i, float tolerance) {
    const std::size_t up = i - grid.columns;
    const std::size_t down = i + grid.columns;
    if (grid.cell[i - 1] != Cell::measured || grid.cell[i + 1] != Cell::measured ||
        grid.cell[up] != Cell::measured || grid.cell[down] != Cell::measured) {
        return false;
    }
    const float along = 2 * grid.y[i] - grid.y[i - 1] - grid.y[i + 1];
    const float across = 2 * grid.y[i] - grid.y[up] - grid.y[down];
    return std::fabs(along) < 2 * tolerance && std::fabs(across) < 2 * tolerance;
}

/// Says whether a window holds regular cells alone.
class RegularReach {
public:
    RegularReach(const VertexGrid& grid, std::vector<std::uint8_t>& flags)
        : grid_(grid), flags_(flags) {}

    bool covers(const Window& window, int code, int column) const {
        if (code < window.half_codes || code + window.half_codes >= grid_.codes ||
            column < window.half_columns || column + window.half_columns >= grid_.columns) {
            return false;
        }
        for (int c = code - window.half_codes; c <= code + window.half_codes; ++c) {
            const std::uint8_t* flag = flags_.data() + grid_.index(c, column);
            // A flag counts how many regular cells in a row end here, so that one look replaces
            // a walk over the row.
            if (flag[window.half_columns] < 2 * window.half_columns + 1) return false;
        }
        return true;
    }

private:
    const VertexGrid& grid_;
    const std::vector<std::uint8_t>& flags_;
};

void countRegularRuns(const VertexGrid& grid, float tolerance, const EdgeNoise& noise, float sigmas,
                      std::vector<std::uint8_t>& flags) {
    flags.assign(grid.size(), 0);
    for (int code = 1; code + 1 < grid.codes; ++code) {
        std::uint8_t run = 0;
        for (int column = 1; column + 1 < grid.columns; ++column) {
            const std::size_t i = grid.index(code, column);
            const float limit = std::max(tolerance, sigmas * noise.pixels(grid.light[i].contrast));
            const bool regular = grid.cell[i] == Cell::measured && isRegular(grid, i, limit);
            run = regular ? std::uint8_t(std::min(run + 1, 255)) : std::uint8_t(0);
            flags[i] = run;
        }
    }
}

/// One row of the grid filtered by the windows' fixed weights, each worked out when first asked
/// for.
class FilteredRow {
public:
    FilteredRow(const VertexGrid& grid, std::vector<float>& memory) : grid_(grid), memory_(memory) {
        memory_.resize(kWindows.size() * grid.columns);
    }

    void start(int code) {
        code_ = code;
        done_.fill(false);
    }

    /// The fit's value at a column whose whole window is measured.
    float at(int window, int column) {
        float* row = memory_.data() + std::size_t(window) * grid_.columns;
        if (!done_[window]) {
            filter(window, row);
            done_[window] = true;
        }
        return row[column];
    }

private:
    void filter(int window, float* __restrict out) const {
        const Window& shape = kWindows[window];
        const int reach = shape.half_columns;
        const int count = grid_.columns - 2 * reach;
        const float* weight = fixedWeights(window).data();
        std::fill_n(out, grid_.columns, 0.0f);
        for (int c = -shape.half_codes; c <= shape.half_codes; ++c) {
            const float* row = grid_.y.data() + grid_.index(code_ + c, 0);
            for (int first = 0; first <= 2 * reach; ++first, ++weight) {
                const float* __restrict in = row + first;
                float* __restrict sums = out + reach;
                const float w = *weight;
#pragma GCC ivdep
                for (int x = 0; x < count; ++x) sums[x] += w * in[x];
            }
        }
    }

    const VertexGrid& grid_;
    std::vector<float>& memory_;
    int code_ = 0;
    std::array<bool, kWindows.size()> done_{};
};

/// The surface at a vertex beside which the window holds something irregular. A crease is no
/// surface for the window, but one for the vertex' own row: a vertex with little noise is kept for
/// that.
RobustFit irregularFit(const VertexGrid& grid, int window, int code, int column, float cutoff,
                       float noise_px) {
    constexpr float kLittleNoise = 0.15f;  // px
    const RobustFit surface =
        robustFit(grid, window, code, column, cutoff, kWindows[window].half_codes);
    if (surface.consistent || noise_px > kLittleNoise) return surface;
    return robustFit(grid, window, code, column, cutoff, 0);
}

}  // namespace

EdgeNoise estimateNoise(const VertexGrid& grid, std::vector<float>& scratch) {
    // The third difference of independent values of variance 1 has the variance 1 + 9 + 9 + 1; the
    // median of a normal variable's modulus is 0.6745 standard deviations.
    constexpr float kMedianToSigma = 1.0f / (0.6745f * 4.4721f);
    scratch.clear();
    const std::size_t row = grid.columns;
    for (std::size_t i = row; i + 3 * row < grid.size(); ++i) {
        const bool complete =
            grid.cell[i] == Cell::measured && grid.cell[i + row] == Cell::measured &&
            grid.cell[i + 2 * row] == Cell::measured && grid.cell[i + 3 * row] == Cell::measured;
        if (!complete) continue;
        const float third =
            grid.y[i + 3 * row] - grid.y[i] - 3 * (grid.y[i + 2 * row] - grid.y[i + row]);
        scratch.push_back(std::fabs(third) * 0.5f *
                          (grid.light[i + row].contrast + grid.light[i + 2 * row].contrast));
    }
    if (scratch.empty()) return {};
    const auto middle = scratch.begin() + std::ptrdiff_t(scratch.size() / 2);
    std::nth_element(scratch.begin(), middle, scratch.end());
    return {*middle * kMedianToSigma};
}

int smoothEdges(const Options& options, const EdgeNoise& noise, SmoothScratch& scratch,
                VertexGrid& grid) {
    const float sigmas = float(options.outlier_sigmas);
    const float floor_px = float(options.noise_floor_px);
    const float largest = float(options.max_residual_px);
    countRegularRuns(grid, sigmas * floor_px, noise, sigmas, scratch.regular_run);
    const RegularReach reach(grid, scratch.regular_run);
    FilteredRow filtered(grid, scratch.filtered_row);

    int emptied = 0;
    grid.scratch = grid.y;
    grid.scratch_cell = grid.cell;
    for (int code = 1; code < grid.codes; ++code) {
        filtered.start(code);
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::end) grid.scratch_cell[i] = Cell::empty;
            if (grid.cell[i] != Cell::measured) continue;
            const float noise_px = noise.pixels(grid.light[i].contrast);
            const int window = windowFor(noise_px);
            if (reach.covers(kWindows[window], code, column)) {
                grid.scratch[i] = filtered.at(window, column);
                continue;
            }
            const float cutoff = std::min(largest, sigmas * std::max(floor_px, noise_px));
            const RobustFit fit = irregularFit(grid, window, code, column, cutoff, noise_px);
            grid.scratch[i] = fit.y;
            if (fit.consistent) continue;
            grid.scratch_cell[i] = Cell::empty;
            ++emptied;
        }
    }
    grid.y.swap(grid.scratch);
    grid.cell.swap(grid.scratch_cell);
    return emptied;
}

}  // namespace facescan
