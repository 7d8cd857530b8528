#pragma once

#include <array>

#include "reconstruct/point.h"
#include "reconstruct/quads.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Scratch memory of computeNormals: the normals of two rows of quads' triangles.
struct NormalScratch {
    struct Row {
        PointPlanes first;
        PointPlanes second;
        std::vector<std::uint8_t> falling;
    };
    std::array<Row, 2> rows;
};

/// The normals of all cells' vertices: the mean of their triangles' normals weighted by area, of
/// unit length. Of cells without a triangle they are void.
///
/// @param side  1 where triangles that turn from the columns' direction to the codes' are seen from
///              outside as they are, −1 where they must be turned over
void computeNormals(const VertexGrid& grid, const PointPlanes& points, const Quads& quads,
                    float side, NormalScratch& scratch, PointPlanes& normals);

}  // namespace facescan
