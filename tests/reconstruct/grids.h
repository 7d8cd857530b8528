#pragma once

#include <functional>

#include "reconstruct/calibrate.h"
#include "reconstruct/vertex_grid.h"

namespace facescan::test {

/// A value for each cell of a vertex grid.
using GridField = std::function<double(int code, int column)>;

/// A grid whose edges have the place `y`; a cell stays empty where that is not a number. Row 0
/// stays empty, as in every grid.
VertexGrid makeGrid(int codes, int columns, const GridField& y, float contrast = 40);

/// Empties the cells of a rectangle.
void cutHole(int code, int column, int codes, int columns, VertexGrid& grid);

int countCells(const VertexGrid& grid, Cell kind);

/// Points as an upright camera sees a plane at 400 mm: 0.2 mm a pixel, X along the columns.
PointPlanes flatPoints(const VertexGrid& grid);

}  // namespace facescan::test
