#include "reconstruct/filter.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/connected_runs.h"
#include "reconstruct/grid_sample.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/median.h"

namespace facescan {
namespace {

/// Goes over the rows of a grid and finds which of its cells continue each other.
class LinkFinder {
public:
    LinkFinder(const VertexGrid& grid, const std::vector<std::uint8_t>& measured,
               const ContinuityLimits& limits, std::vector<std::uint8_t>& memory)
        : grid_(grid), measured_(measured), limits_(limits) {
        const std::size_t length = grid.columns + 2 * kLargestGap;
        memory.assign(length * (kLargestGap + 3), 0);
        std::uint8_t* row = memory.data() + kLargestGap;
        for (std::uint8_t** flags : {&links_.along[0], &links_.along[1], &links_.along[2],
                                     &links_.across, &from_before_}) {
            *flags = row;
            row += length;
        }
        no_next_ = row;
    }

    /// Goes on to the next row, beginning with the first. @returns whether it holds cells
    bool next(int code) {
        std::swap(links_.across, from_before_);
        std::fill_n(links_.across, grid_.columns, std::uint8_t(0));
        for (std::uint8_t* flags : links_.along) std::fill_n(flags, grid_.columns, std::uint8_t(0));
        const auto [first, end] = grid_.extent[code];
        if (first >= end) return false;

        const std::size_t row = grid_.index(code, 0);
        const bool has_next = code + 1 < grid_.codes;
        const std::size_t next_row = has_next ? row + grid_.columns : row;
        kernels().linkNeighbours(
            {grid_.y.data() + row, grid_.y.data() + next_row, measured_.data() + row,
             has_next ? measured_.data() + next_row : no_next_},
            limits_, first, end, links_);
        // What lies beyond the last column is the next row.
        for (int gap = 1; gap <= kLargestGap; ++gap) {
            const int inside = std::max(grid_.columns - gap, 0);
            std::fill(links_.along[gap - 1] + inside, links_.along[gap - 1] + grid_.columns,
                      std::uint8_t(0));
        }
        return true;
    }

    const RowLinks& links() const { return links_; }
    /// Flags of the cells that continue the row before.
    const std::uint8_t* fromBefore() const { return from_before_; }

private:
    const VertexGrid& grid_;
    const std::vector<std::uint8_t>& measured_;
    ContinuityLimits limits_;
    RowLinks links_;
    std::uint8_t* from_before_;
    const std::uint8_t* no_next_;  ///< measured cells of a row beyond the last
};

/// Leaves in scratch.kept the measured cells that two neighbours or more continue. @returns how
/// many are not among them
int rejectUnsupported(const ContinuityLimits& limits, const VertexGrid& grid,
                      FilterScratch& scratch) {
    markMeasured(grid, scratch.measured);
    scratch.kept.assign(scratch.measured.size(), 0);
    LinkFinder finder(grid, scratch.measured, limits, scratch.row);
    int rejected = 0;
    for (int code = 1; code < grid.codes; ++code) {
        if (!finder.next(code)) continue;
        const std::size_t row = grid.index(code, 0);
        const auto [first, end] = grid.extent[code];
        rejected += kernels().rejectUnsupported(finder.links(), finder.fromBefore(),
                                                scratch.measured.data() + row, first, end,
                                                scratch.kept.data() + row);
    }
    return rejected;
}

/// Finds the runs of all rows of kept cells, and which of them are one piece.
void findRuns(const ContinuityLimits& limits, const VertexGrid& grid, FilterScratch& scratch) {
    std::vector<SurfaceRun>& runs = scratch.runs;
    runs.clear();
    for (std::vector<std::uint32_t>& row : scratch.run_of) row.resize(grid.columns);
    LinkFinder finder(grid, scratch.kept, limits, scratch.row);
    for (int code = 1; code < grid.codes; ++code) {
        if (!finder.next(code)) continue;
        const RowLinks& links = finder.links();
        const std::uint8_t* from_before = finder.fromBefore();
        const std::uint8_t* kept = scratch.kept.data() + grid.index(code, 0);
        std::uint32_t* run_of = scratch.run_of[code % 2].data();
        const std::uint32_t* run_before = scratch.run_of[(code + 1) % 2].data();
        constexpr std::uint32_t kNone = ~0u;
        std::uint32_t joined = kNone;  // the run of the row before that was joined last
        std::uint32_t cells = 0;
        bool continues = false;
        for (int x = grid.extent[code].first; x < grid.extent[code].end; ++x) {
            if (!kept[x]) continue;
            if (!continues) {
                runs.push_back({code, x, x, 0, std::uint32_t(runs.size())});
                joined = kNone;
                cells = 0;
            }
            ++cells;
            const auto run = std::uint32_t(runs.size() - 1);
            run_of[x] = run;
            if (from_before[x] && run_before[x] != joined) {
                joined = run_before[x];
                joinRuns(runs, joined, run, [](SurfaceRun& root, const SurfaceRun& other) {
                    root.cells += other.cells;
                });
            }
            continues = links.along[0][x] | links.along[1][x] | links.along[2][x];
            if (continues) continue;
            runs[run].last = x;
            runs[rootOf(runs, run)].cells += cells;
        }
    }
}

/// Keeps no pieces of few cells. @returns how many cells these had
int rejectSmallPieces(int min_component, FilterScratch& scratch, const VertexGrid& grid) {
    int rejected = 0;
    for (std::uint32_t i = 0; i < scratch.runs.size(); ++i) {
        SurfaceRun& run = scratch.runs[i];
        if (scratch.runs[rootOf(scratch.runs, i)].cells >=
            std::uint32_t(std::max(min_component, 0)))
            continue;
        std::uint8_t* kept = scratch.kept.data() + grid.index(run.code, 0);
        for (int x = run.first; x <= run.last; ++x) {
            rejected += kept[x];
            kept[x] = 0;
        }
    }
    return rejected;
}

/// Marks both ends of the runs.
void markEnds(int columns, const std::vector<SurfaceRun>& runs, VertexGrid& grid) {
    for (const SurfaceRun& run : runs) {
        Cell* cell = grid.cell.data() + grid.index(run.code, 0);
        const auto mark = [&](int first, int last) {
            for (int x = first; x <= last; ++x) {
                if (cell[x] == Cell::measured) cell[x] = Cell::end;
            }
        };
        mark(run.first, std::min(run.first + columns - 1, run.last));
        mark(std::max(run.last - columns + 1, run.first), run.last);
    }
}

}  // namespace

float medianStripeWidth(const VertexGrid& grid, std::vector<float>& scratch) {
    scratch.clear();
    const std::size_t row = grid.columns;
    forEachSample(grid, 1, [&](std::size_t i) {
        if (grid.cell[i + row] != Cell::measured) return;
        scratch.push_back(std::fabs(grid.y[i + row] - grid.y[i]));
    });
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
    int rejected = rejectUnsupported(limits, grid, scratch);
    findRuns(limits, grid, scratch);
    rejected += rejectSmallPieces(options.min_component, scratch, grid);
    static_assert(int(Cell::empty) == 0 && int(Cell::measured) == 1);
    for (std::size_t i = 0; i < grid.size(); ++i) grid.cell[i] = Cell(scratch.kept[i]);
    markEnds(options.end_columns, scratch.runs, grid);
    return rejected;
}

}  // namespace facescan
