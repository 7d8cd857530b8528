#include "reconstruct/filter.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/kernels/kernels.h"
#include "reconstruct/median.h"

namespace facescan {
namespace {

/// Flags of the cells of a row, by column; readable kLargestGap columns beyond either end.
struct Links {
    std::array<std::uint8_t*, kLargestGap>
        along;                  ///< continued by the next cell, so many columns on
    std::uint8_t* across;       ///< continued in the next row
    std::uint8_t* from_before;  ///< continues the row before
};

/// Goes over the rows of a grid and finds which of its cells continue each other.
class LinkFinder {
public:
    LinkFinder(const VertexGrid& grid, const std::vector<std::uint8_t>& measured,
               const ContinuityLimits& limits, std::vector<std::uint8_t>& memory)
        : grid_(grid), measured_(measured), limits_(limits) {
        const std::size_t length = grid.columns + 2 * kLargestGap;
        memory.assign(length * (kLargestGap + 2), 0);
        std::uint8_t* row = memory.data() + kLargestGap;
        for (std::uint8_t*& flags : links_.along) {
            flags = row;
            row += length;
        }
        links_.across = row;
        links_.from_before = row + length;
    }

    /// Rows are asked for one after the other, from the first on.
    const Links& next(int code) {
        std::swap(links_.across, links_.from_before);
        std::fill_n(links_.across, grid_.columns, std::uint8_t(0));
        for (std::uint8_t* flags : links_.along) std::fill_n(flags, grid_.columns, 0);
        const auto [first, end] = grid_.extent[code];
        if (first >= end) return links_;

        const std::size_t row = grid_.index(code, 0);
        const bool has_next = code + 1 < grid_.codes;
        const float* y = grid_.y.data() + row;
        const float* next_row = has_next ? y + grid_.columns : y;
        kernels().compareNeighbours(y, next_row, limits_, first, end,
                                    {links_.along, links_.across});
        const std::uint8_t* m = measured_.data() + row;
        for (int x = first; x < end; ++x) {
            // The next cell counts, and no other beyond it.
            const std::uint8_t none1 = std::uint8_t(m[x + 1] ^ 1);
            const std::uint8_t none2 = std::uint8_t(m[x + 2] ^ 1) & none1;
            links_.along[0][x] &= m[x] & m[x + 1];
            links_.along[1][x] &= m[x] & m[x + 2] & none1;
            links_.along[2][x] &= m[x] & m[x + 3] & none2;
        }
        for (int x = std::max(grid_.columns - kLargestGap, 0); x < grid_.columns; ++x) {
            for (int gap = 1; gap <= kLargestGap; ++gap) {
                if (x + gap >= grid_.columns) links_.along[gap - 1][x] = 0;
            }
        }
        const std::uint8_t* below = has_next ? m + grid_.columns : m;
        const std::uint8_t exists = has_next;
        for (int x = first; x < end; ++x) links_.across[x] &= m[x] & below[x] & exists;
        return links_;
    }

private:
    const VertexGrid& grid_;
    const std::vector<std::uint8_t>& measured_;
    ContinuityLimits limits_;
    Links links_;
};

/// Empties the cells that fewer than two neighbours continue.
int rejectUnsupported(const ContinuityLimits& limits, FilterScratch& scratch, VertexGrid& grid) {
    markMeasured(grid, scratch.measured);
    LinkFinder finder(grid, scratch.measured, limits, scratch.row);
    int rejected = 0;
    for (int code = 1; code < grid.codes; ++code) {
        const auto& [along, across, from_before] = finder.next(code);
        const std::uint8_t* measured = scratch.measured.data() + grid.index(code, 0);
        Cell* cell = grid.cell.data() + grid.index(code, 0);
        int emptied = 0;
        for (int x = grid.extent[code].first; x < grid.extent[code].end; ++x) {
            const int support = along[0][x] + along[1][x] + along[2][x] + along[0][x - 1] +
                                along[1][x - 2] + along[2][x - 3] + across[x] + from_before[x];
            const bool unsupported = measured[x] && support < 2;
            cell[x] = unsupported ? Cell::empty : cell[x];
            emptied += unsupported;
        }
        rejected += emptied;
    }
    return rejected;
}

std::uint32_t findRoot(std::vector<SurfaceRun>& runs, std::uint32_t i) {
    while (runs[i].connected != i) {
        runs[i].connected = runs[runs[i].connected].connected;
        i = runs[i].connected;
    }
    return i;
}

void join(std::vector<SurfaceRun>& runs, std::uint32_t a, std::uint32_t b) {
    a = findRoot(runs, a);
    b = findRoot(runs, b);
    if (a == b) return;
    runs[b].connected = a;
    runs[a].cells += runs[b].cells;
}

/// Finds the runs of all rows, and which of them are one piece.
void findRuns(const ContinuityLimits& limits, FilterScratch& scratch, const VertexGrid& grid) {
    markMeasured(grid, scratch.measured);
    scratch.runs.clear();
    for (std::vector<std::uint32_t>& row : scratch.run_of) row.resize(grid.columns);
    LinkFinder finder(grid, scratch.measured, limits, scratch.row);
    for (int code = 1; code < grid.codes; ++code) {
        const auto& [along, across, from_before] = finder.next(code);
        const std::uint8_t* measured = scratch.measured.data() + grid.index(code, 0);
        std::uint32_t* run_of = scratch.run_of[code % 2].data();
        const std::uint32_t* run_before = scratch.run_of[(code + 1) % 2].data();
        bool continues = false;
        std::uint32_t last_before = 0;
        std::uint32_t last_here = ~0u;
        for (int x = grid.extent[code].first; x < grid.extent[code].end; ++x) {
            if (!measured[x]) continue;
            if (!continues) {
                scratch.runs.push_back({code, x, x, 0, std::uint32_t(scratch.runs.size())});
            }
            continues = along[0][x] | along[1][x] | along[2][x];
            const auto run = std::uint32_t(scratch.runs.size() - 1);
            scratch.runs[run].last = x;
            ++scratch.runs[findRoot(scratch.runs, run)].cells;
            run_of[x] = run;
            if (!from_before[x] || (run == last_here && run_before[x] == last_before)) continue;
            last_here = run;
            last_before = run_before[x];
            join(scratch.runs, last_before, run);
        }
    }
}

void setCells(VertexGrid& grid, int code, int first, int last, Cell to) {
    for (int x = first; x <= last; ++x) {
        Cell& cell = grid.cell[grid.index(code, x)];
        if (cell == Cell::measured) cell = to;
    }
}

/// Empties the pieces of few cells; marks both ends of the runs that stay.
int sortRuns(const Options& options, std::vector<SurfaceRun>& runs, VertexGrid& grid) {
    int rejected = 0;
    for (std::uint32_t i = 0; i < runs.size(); ++i) {
        const SurfaceRun& run = runs[i];
        if (runs[findRoot(runs, i)].cells < std::uint32_t(std::max(options.min_component, 0))) {
            for (int x = run.first; x <= run.last; ++x) {
                rejected += grid.cell[grid.index(run.code, x)] == Cell::measured;
            }
            setCells(grid, run.code, run.first, run.last, Cell::empty);
            continue;
        }
        const int trim = options.end_columns;
        setCells(grid, run.code, run.first, std::min(run.first + trim - 1, run.last), Cell::end);
        setCells(grid, run.code, std::max(run.last - trim + 1, run.first), run.last, Cell::end);
    }
    return rejected;
}

}  // namespace

float medianStripeWidth(const VertexGrid& grid, std::vector<float>& scratch) {
    scratch.clear();
    const std::size_t row = grid.columns;
    const int step = samplingStep(grid.size());
    for (int code = 1; code + 1 < grid.codes; ++code) {
        const int first = grid.extent[code].first;
        for (int column = first + code % step; column < grid.extent[code].end; column += step) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::measured && grid.cell[i + row] == Cell::measured) {
                scratch.push_back(std::fabs(grid.y[i + row] - grid.y[i]));
            }
        }
    }
    return medianOf(scratch);
}

int rejectFalseEdges(const Options& options, bool rising, FilterScratch& scratch,
                     VertexGrid& grid) {
    const float stripe_width = medianStripeWidth(grid, scratch.widths);
    // Slopes towards and away from the projector squeeze and stretch the stripes.
    const ContinuityLimits limits{.max_step = float(options.max_step_px),
                                  .min_width = 0.4f * stripe_width,
                                  .max_width = 3.5f * stripe_width,
                                  .sign = rising ? 1.0f : -1.0f};
    const int unsupported = rejectUnsupported(limits, scratch, grid);
    findRuns(limits, scratch, grid);
    return unsupported + sortRuns(options, scratch.runs, grid);
}

}  // namespace facescan
