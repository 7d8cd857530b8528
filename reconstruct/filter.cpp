#include "reconstruct/filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace facescan {
namespace {

/// Cells of one row that lie this far apart, with nothing between, can still be one surface.
constexpr int kMaxGapColumns = 3;

/// Says which cells continue each other.
class Continuity {
public:
    Continuity(const VertexGrid& grid, float max_step, float stripe_width, bool rising)
        : grid_(grid),
          max_step_(max_step),
          // Slopes towards and away from the projector squeeze and stretch the stripes.
          min_width_(0.4f * stripe_width),
          max_width_(3.5f * stripe_width),
          sign_(rising ? 1.0f : -1.0f) {}

    bool alongStripe(std::size_t left, std::size_t right) const {
        return std::fabs(grid_.y[right] - grid_.y[left]) <= max_step_ * float(right - left);
    }

    bool acrossStripes(std::size_t lower_code, std::size_t higher_code) const {
        const float width = sign_ * (grid_.y[higher_code] - grid_.y[lower_code]);
        return width > min_width_ && width < max_width_;
    }

    bool toNextCode(std::size_t i) const {
        const std::size_t next = i + grid_.columns;
        return next < grid_.size() && grid_.cell[next] == Cell::measured && acrossStripes(i, next);
    }

private:
    const VertexGrid& grid_;
    float max_step_;
    float min_width_;
    float max_width_;
    float sign_;
};

/// The next measured cell of the row after `column`, at most kMaxGapColumns on; −1 if none.
int nextInRow(const VertexGrid& grid, int code, int column) {
    const int last = std::min(column + kMaxGapColumns, grid.columns - 1);
    for (int next = column + 1; next <= last; ++next) {
        if (grid.cell[grid.index(code, next)] == Cell::measured) return next;
    }
    return -1;
}

/// Counts for each cell the neighbours that continue it, and empties those with fewer than two.
int rejectUnsupported(const Continuity& continuity, std::vector<std::uint32_t>& support,
                      VertexGrid& grid) {
    support.assign(grid.size(), 0);
    for (int code = 1; code < grid.codes; ++code) {
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] != Cell::measured) continue;
            const int next = nextInRow(grid, code, column);
            if (next >= 0 && continuity.alongStripe(i, grid.index(code, next))) {
                ++support[i];
                ++support[grid.index(code, next)];
            }
            if (continuity.toNextCode(i)) {
                ++support[i];
                ++support[i + grid.columns];
            }
        }
    }
    int rejected = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid.cell[i] == Cell::measured && support[i] < 2) {
            grid.cell[i] = Cell::empty;
            ++rejected;
        }
    }
    return rejected;
}

void markRange(VertexGrid& grid, int code, int begin, int end) {
    for (int column = begin; column < end; ++column) {
        Cell& cell = grid.cell[grid.index(code, column)];
        if (cell == Cell::measured) cell = Cell::end;
    }
}

/// Marks both ends of every run of a row that continues without a jump.
void markEnds(const Continuity& continuity, int trim, VertexGrid& grid) {
    if (trim <= 0) return;
    for (int code = 1; code < grid.codes; ++code) {
        for (int column = 0; column < grid.columns;) {
            if (grid.cell[grid.index(code, column)] != Cell::measured) {
                ++column;
                continue;
            }
            int end = column;
            int next = nextInRow(grid, code, end);
            while (next >= 0 &&
                   continuity.alongStripe(grid.index(code, end), grid.index(code, next))) {
                end = next;
                next = nextInRow(grid, code, end);
            }
            markRange(grid, code, column, std::min(column + trim, end + 1));
            markRange(grid, code, std::max(end + 1 - trim, column), end + 1);
            column = end + 1;
        }
    }
}

std::uint32_t findRoot(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

/// The root of a joined component is its first cell.
void join(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
    a = findRoot(parent, a);
    b = findRoot(parent, b);
    if (a < b) parent[b] = a;
    if (b < a) parent[a] = b;
}

int rejectSmallComponents(const Continuity& continuity, int min_component, FilterScratch& scratch,
                          VertexGrid& grid) {
    std::vector<std::uint32_t>& parent = scratch.component;
    parent.resize(grid.size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (int code = 1; code < grid.codes; ++code) {
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] != Cell::measured) continue;
            const int next = nextInRow(grid, code, column);
            if (next >= 0 && continuity.alongStripe(i, grid.index(code, next))) {
                join(parent, std::uint32_t(i), std::uint32_t(grid.index(code, next)));
            }
            if (continuity.toNextCode(i)) {
                join(parent, std::uint32_t(i), std::uint32_t(i + grid.columns));
            }
        }
    }

    scratch.component_size.assign(grid.size(), 0);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid.cell[i] == Cell::measured) {
            ++scratch.component_size[findRoot(parent, std::uint32_t(i))];
        }
    }
    int rejected = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid.cell[i] != Cell::measured) continue;
        if (scratch.component_size[findRoot(parent, std::uint32_t(i))] <
            std::uint32_t(min_component)) {
            grid.cell[i] = Cell::empty;
            ++rejected;
        }
    }
    return rejected;
}

}  // namespace

float medianStripeWidth(const VertexGrid& grid, std::vector<float>& scratch) {
    scratch.clear();
    for (std::size_t i = 0; i + grid.columns < grid.size(); ++i) {
        if (grid.cell[i] == Cell::measured && grid.cell[i + grid.columns] == Cell::measured) {
            scratch.push_back(std::fabs(grid.y[i + grid.columns] - grid.y[i]));
        }
    }
    if (scratch.empty()) return 0;
    const auto middle = scratch.begin() + std::ptrdiff_t(scratch.size() / 2);
    std::nth_element(scratch.begin(), middle, scratch.end());
    return *middle;
}

int rejectFalseEdges(const Options& options, bool rising, FilterScratch& scratch,
                     VertexGrid& grid) {
    const float stripe_width = medianStripeWidth(grid, scratch.widths);
    const Continuity continuity(grid, float(options.max_step_px), stripe_width, rising);
    int rejected = rejectUnsupported(continuity, scratch.component, grid);
    rejected += rejectSmallComponents(continuity, options.min_component, scratch, grid);
    markEnds(continuity, options.end_columns, grid);
    return rejected;
}

}  // namespace facescan
