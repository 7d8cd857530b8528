#include "reconstruct/fill.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

using Terms = std::array<float, 6>;

constexpr std::uint8_t kVisited = 1;
constexpr std::uint8_t kOnRim = 2;
constexpr std::uint8_t kFilled = 4;

/// Collects the empty cells connected with `seed` over sides.
/// @returns whether they stay off the border of the grid
bool collectRegion(const VertexGrid& grid, std::size_t seed, FillScratch& scratch) {
    bool enclosed = true;
    const auto visit = [&](std::size_t i) {
        if (grid.cell[i] != Cell::empty || scratch.visited[i] & kVisited) return;
        scratch.visited[i] |= kVisited;
        scratch.region.push_back(std::uint32_t(i));
    };
    scratch.region.clear();
    visit(seed);
    for (std::size_t next = 0; next < scratch.region.size(); ++next) {
        const std::size_t i = scratch.region[next];
        const int code = int(i / grid.columns);
        const int column = int(i % grid.columns);
        if (code <= 1 || code + 1 >= grid.codes || column == 0 || column + 1 >= grid.columns) {
            enclosed = false;
            if (code < 1) continue;
        }
        if (column > 0) visit(i - 1);
        if (column + 1 < grid.columns) visit(i + 1);
        if (code > 1) visit(i - grid.columns);
        if (code + 1 < grid.codes) visit(i + grid.columns);
    }
    return enclosed;
}

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
                if (grid.cell[n] == Cell::empty || scratch.visited[n] & kOnRim) continue;
                scratch.visited[n] |= kOnRim;
                scratch.rim.push_back(std::uint32_t(n));
            }
        }
    }
    for (const std::uint32_t n : scratch.rim) scratch.visited[n] &= std::uint8_t(~kOnRim);
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
    scratch.visited.assign(grid.size(), 0);
    scratch.residual.resize(grid.size());
    for (std::size_t seed = grid.columns; seed < grid.size(); ++seed) {
        if (grid.cell[seed] != Cell::empty || scratch.visited[seed] & kVisited) continue;
        if (!collectRegion(grid, seed, scratch)) continue;
        ++counts.found;
        if (!fillRegion(options, points, scratch, grid)) continue;
        // Marked at once, a hole would pass for the rim of the next.
        ++counts.filled;
        for (const std::uint32_t i : scratch.region) scratch.visited[i] |= kFilled;
    }
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (scratch.visited[i] & kFilled) grid.cell[i] = Cell::filled;
    }
    return counts;
}

}  // namespace facescan
