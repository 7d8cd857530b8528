#include "reconstruct/fill.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reconstruct/byte_group.h"
#include "reconstruct/connected_runs.h"
#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

using Terms = std::array<float, 6>;

/// Finds the runs of empty cells of all rows but row 0, and which of them are connected over sides.
/// Those connected with the border of the grid are none.
class EmptyRegions {
public:
    EmptyRegions(const VertexGrid& grid, std::vector<EmptyRun>& runs) : runs_(runs) {
        runs.clear();
        std::size_t before = 0;  // the first run of the row before
        for (int code = 1; code < grid.codes; ++code) {
            const std::size_t here = runs.size();
            findRuns(grid, code);
            joinRows(before, here);
            before = here;
        }
        // A root comes before all runs of its region.
        for (std::uint32_t i = 0; i < runs.size(); ++i) {
            const std::uint32_t root = rootOf(runs, i);
            runs[i].next = kNone;
            if (root == i) {
                runs[i].tail = i;
            } else {
                runs[runs[root].tail].next = i;
                runs[root].tail = i;
            }
        }
    }

    /// Calls take(cells) with the cells of each region that does not touch the border.
    template <typename Take>
    void forEnclosed(const VertexGrid& grid, std::vector<std::uint32_t>& cells, Take take) const {
        for (std::uint32_t root = 0; root < runs_.size(); ++root) {
            if (runs_[root].connected != root || runs_[root].open) continue;
            cells.clear();
            for (std::uint32_t i = root; i != kNone; i = runs_[i].next) {
                for (int x = runs_[i].first; x < runs_[i].end; ++x) {
                    cells.push_back(std::uint32_t(grid.index(runs_[i].code, x)));
                }
            }
            take();
        }
    }

private:
    static constexpr std::uint32_t kNone = ~0u;

    void findRuns(const VertexGrid& grid, int code) {
        constexpr auto kEmpty = std::uint8_t(Cell::empty);
        const Cell* cell = grid.cell.data() + grid.index(code, 0);
        const int columns = grid.columns;
        const bool border_row = code == 1 || code + 1 == grid.codes;
        for (int x = 0; x < columns;) {
            x += ByteGroup(cell + x).matches(kEmpty).lead();
            if (x >= columns) break;
            if (cell[x] != Cell::empty) continue;
            const int first = x;
            int run = 0;
            do {
                run = ByteGroup(cell + x).matches(kEmpty).run();
                x += run;
            } while (run == ByteGroup::kSize && x < columns);
            const int end = std::min(x, columns);
            const bool open = border_row || first == 0 || end == columns;
            const auto self = std::uint32_t(runs_.size());
            runs_.push_back({code, first, end, open, self, kNone, kNone});
        }
    }

    /// Joins the runs from `before` on with those from `here` on, of the next row, that they touch.
    void joinRows(std::size_t before, std::size_t here) {
        std::size_t above = before;
        std::size_t below = here;
        while (above < here && below < runs_.size()) {
            const EmptyRun& a = runs_[above];
            const EmptyRun& b = runs_[below];
            if (a.first < b.end && b.first < a.end) {
                joinRuns(runs_, std::uint32_t(above), std::uint32_t(below),
                         [](EmptyRun& root, const EmptyRun& other) { root.open |= other.open; });
            }
            ++(a.end < b.end ? above : below);
        }
    }

    std::vector<EmptyRun>& runs_;
};

/// Collects the cells of the surface up to two cells from the region.
void collectRim(const VertexGrid& grid, FillScratch& scratch) {
    constexpr int kDepth = 2;
    scratch.rim.clear();
    for (const std::uint32_t i : scratch.region) {
        const int code = int(i / grid.columns);
        const int column = int(i % grid.columns);
        for (int c = std::max(code - kDepth, 1); c <= std::min(code + kDepth, grid.codes - 1);
             ++c) {
            const int last = std::min(column + kDepth, grid.columns - 1);
            for (int x = std::max(column - kDepth, 0); x <= last; ++x) {
                const std::size_t n = grid.index(c, x);
                if (grid.cell[n] == Cell::empty || scratch.on_rim[n]) continue;
                scratch.on_rim[n] = 1;
                scratch.rim.push_back(std::uint32_t(n));
            }
        }
    }
    for (const std::uint32_t n : scratch.rim) scratch.on_rim[n] = 0;
}

/// The diagonal of the box around the cells that touch the region, mm.
float extent(const VertexGrid& grid, const FillScratch& scratch, const PointPlanes& points) {
    constexpr float kFar = 1e9f;
    Point low{kFar, kFar, kFar};
    Point high{-kFar, -kFar, -kFar};
    for (const std::uint32_t i : scratch.region) {
        for (const std::size_t n : {i - std::size_t(1), i + std::size_t(1),
                                    i - std::size_t(grid.columns), i + std::size_t(grid.columns)}) {
            if (grid.cell[n] == Cell::empty) continue;
            const Point p = points[n];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    }
    const float x = high.x - low.x;
    const float y = high.y - low.y;
    const float z = high.z - low.z;
    return std::sqrt(x * x + y * y + z * z);
}

/// A quadratic in column and code around the middle of a region.
class QuadraticSurface {
public:
    /// @returns whether the rim determines the surface
    bool fit(const VertexGrid& grid, const FillScratch& scratch) {
        const std::size_t middle = scratch.region[scratch.region.size() / 2];
        code_ = int(middle / grid.columns);
        column_ = int(middle % grid.columns);
        columns_ = grid.columns;
        NormalEquations<float, 6> equations;
        for (const std::uint32_t i : scratch.rim) equations.add(terms(i), grid.y[i], 1.0f);
        for (int term = 3; term < 6; ++term) equations.damp(term, 1e-3f);
        return scratch.rim.size() >= 6 && equations.solve(solution_);
    }

    float at(std::size_t i) const {
        const Terms t = terms(i);
        float y = 0;
        for (int term = 0; term < 6; ++term) y += solution_[term] * t[term];
        return y;
    }

private:
    Terms terms(std::size_t i) const {
        constexpr float kScale = 0.125f;
        const float v = float(int(i / columns_) - code_) * kScale;
        const float u = float(int(i % columns_) - column_) * kScale;
        return {1, v, u, v * u, u * u, v * v};
    }

    int code_ = 0;
    int column_ = 0;
    int columns_ = 1;
    Terms solution_{};
};

/// Spreads the rim's residuals over the region: Gauss–Seidel steps on Laplace's equation. Columns
/// lie about a third as far apart as codes, hence the weights.
void spreadResiduals(const VertexGrid& grid, FillScratch& scratch) {
    constexpr float kAlong = 9.0f;
    constexpr float kAcross = 1.0f;
    constexpr int kSteps = 40;
    const std::size_t row = grid.columns;
    std::vector<float>& e = scratch.residual;
    for (const std::uint32_t i : scratch.region) e[i] = 0;
    for (int step = 0; step < kSteps; ++step) {
        for (const std::uint32_t i : scratch.region) {
            e[i] = (kAlong * (e[i - 1] + e[i + 1]) + kAcross * (e[i - row] + e[i + row])) /
                   (2 * (kAlong + kAcross));
        }
    }
}

bool fillRegion(const Options& options, const PointPlanes& points, FillScratch& scratch,
                VertexGrid& grid) {
    collectRim(grid, scratch);
    if (extent(grid, scratch, points) > float(options.max_hole_mm)) return false;
    QuadraticSurface surface;
    if (!surface.fit(grid, scratch)) return false;

    float squares = 0;
    for (const std::uint32_t i : scratch.rim) {
        scratch.residual[i] = grid.y[i] - surface.at(i);
        squares += scratch.residual[i] * scratch.residual[i];
    }
    const float limit = float(options.max_rim_residual_px);
    if (squares > limit * limit * float(scratch.rim.size())) return false;

    spreadResiduals(grid, scratch);
    for (const std::uint32_t i : scratch.region) {
        grid.y[i] = surface.at(i) + scratch.residual[i];
        grid.contrast[i] = 0;
    }
    return true;
}

}  // namespace

FillCounts fillHoles(const Options& options, const PointPlanes& points, FillScratch& scratch,
                     VertexGrid& grid) {
    FillCounts counts;
    scratch.on_rim.resize(grid.size());
    scratch.residual.resize(grid.size());
    scratch.filled.clear();
    const EmptyRegions regions(grid, scratch.runs);
    regions.forEnclosed(grid, scratch.region, [&] {
        ++counts.found;
        if (!fillRegion(options, points, scratch, grid)) return;
        ++counts.filled;
        scratch.filled.insert(scratch.filled.end(), scratch.region.begin(), scratch.region.end());
    });
    // Marked at once, a hole would pass for the rim of the next.
    for (const std::uint32_t i : scratch.filled) grid.cell[i] = Cell::filled;
    return counts;
}

}  // namespace facescan
