#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/point.h"
#include "reconstruct/quads.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Scratch memory of tessellate.
struct TessellateScratch {
    std::vector<std::uint8_t> present;  ///< by cell
    std::vector<float> first_longest;   ///< by quad: square of the triangle's longest edge, mm²
    std::vector<float> second_longest;
    std::vector<std::int32_t> lengths;  ///< of one row
    std::vector<std::uint8_t> suspect;  ///< of one row
    std::vector<std::uint32_t> again;   ///< cells whose fans are to be looked at once more
};

/// Connects neighbouring cells of the grid to triangles: along the shorter diagonal of four cells,
/// or of three.
///
/// A triangle whose longest edge is options.max_edge_ratio times the mean of the longest edges or
/// more, or that is seen from behind, spans a gap and is left out. Where triangles meet at a vertex
/// without sharing an edge, the largest fan stays: the mesh is a manifold with a boundary.
///
/// @param rising  whether the code rises with y
/// @param points  the points of all cells that are not empty
void tessellate(const Options& options, const VertexGrid& grid, const PointPlanes& points,
                bool rising, TessellateScratch& scratch, Quads& quads);

}  // namespace facescan
