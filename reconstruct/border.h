#pragma once

#include "reconstruct/calibrate.h"
#include "reconstruct/pixel_planes.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Carries the surface on to the image's first and last row, where the image ends and not the
/// surface: the last stripe of a column reaches the border, and its far edge would lie beyond. That
/// edge's cell is filled with the place where the line through the last two edges meets the border.
///
/// @param rising  whether the code rises with y
/// @param points  of all cells that are not empty; those of the filled cells are added
/// @returns the number of cells filled
int carryToBorder(const GridCalibration& calibration, const PixelPlanes& planes, bool rising,
                  VertexGrid& grid, PointPlanes& points);

}  // namespace facescan
