#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/calibrate.h"
#include "reconstruct/mesh.h"
#include "reconstruct/options.h"
#include "reconstruct/scan.h"
#include "reconstruct/smooth.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Scratch memory of tessellate.
struct TessellateScratch {
    std::vector<std::uint8_t> quads;    ///< which triangles each quad of cells carries
    std::vector<std::uint32_t> vertex;  ///< by cell: index of its vertex in the mesh
};

/// Connects neighbouring cells of the grid to triangles, counter-clockwise seen from the camera,
/// and lays down the vertices that they use, with texture coordinates and quality. Normals are left
/// for addNormals().
///
/// A quad of four cells gives two triangles along its shorter diagonal, three cells give one. A
/// triangle whose longest edge is options.max_edge_ratio times the mean of the longest edges or
/// more, or that is seen from behind, spans a gap and is left out. Where triangles meet at a vertex
/// without sharing an edge, the largest fan stays: the mesh is a manifold with a boundary.
///
/// @param rising    whether the code rises with y
/// @param points    the points of all cells that are not empty
/// @param noise  of the edges: the source of the vertices' quality
void tessellate(const ScanDescription& scan, const Options& options, const VertexGrid& grid,
                const std::vector<Point>& points, bool rising, const EdgeNoise& noise,
                TessellateScratch& scratch, Mesh& mesh);

}  // namespace facescan
