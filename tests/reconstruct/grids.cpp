#include "reconstruct/grids.h"

#include <algorithm>
#include <cmath>

namespace facescan::test {

VertexGrid makeGrid(int codes, int columns, const GridField& y, float contrast) {
    VertexGrid grid;
    grid.reset(codes, columns);
    for (int code = 1; code < codes; ++code) grid.extent[code] = {0, columns};
    for (int code = 1; code < codes; ++code) {
        for (int column = 0; column < columns; ++column) {
            const double place = y(code, column);
            if (!std::isfinite(place)) continue;
            const std::size_t i = grid.index(code, column);
            grid.cell[i] = Cell::measured;
            grid.y[i] = float(place);
            grid.contrast[i] = contrast;
            grid.drift_gain[i] = 100 / contrast;
        }
    }
    return grid;
}

void cutHole(int code, int column, int codes, int columns, VertexGrid& grid) {
    for (int c = code; c < code + codes; ++c) {
        for (int x = column; x < column + columns; ++x) {
            grid.cell[grid.index(c, x)] = Cell::empty;
        }
    }
}

int countCells(const VertexGrid& grid, Cell kind) {
    return int(
        std::count(grid.cell.begin(), grid.cell.begin() + std::ptrdiff_t(grid.size()), kind));
}

PointPlanes flatPoints(const VertexGrid& grid) {
    PointPlanes points;
    points.resize(grid.size() + VertexGrid::kBeyond);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const float column = float(int(i % grid.columns));
        points.set(i, {0.2f * (column - 0.5f * float(grid.columns)), 0.2f * grid.y[i], 400.0f});
    }
    return points;
}

}  // namespace facescan::test
