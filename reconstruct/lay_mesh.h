#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/mesh.h"
#include "reconstruct/point.h"
#include "reconstruct/quads.h"
#include "reconstruct/scan.h"
#include "reconstruct/smooth.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Whether triangles that turn on the grid from the columns' direction to the codes' are clockwise
/// in the camera's image: a rising code has it so, and a turned image turns them round.
inline bool turnsClockwise(const Pattern& pattern, bool rising) {
    return rising != (pattern.axis == CodeAxis::x);
}

/// Scratch memory of layMesh.
struct LayMeshScratch {
    std::vector<std::uint8_t> used;                    ///< by cell: 1 where a triangle uses it
    std::vector<float> quality;                        ///< of one row
    std::array<std::vector<std::uint32_t>, 2> vertex;  ///< by column, in two rows: its index
};

/// Lays down the vertices that the quads' triangles use, row after row of the grid, with texture
/// coordinates and quality, and the triangles, counter-clockwise seen from the camera.
///
/// @param points, normals  of all cells that are not empty
/// @param noise            of the edges: the source of the vertices' quality
void layMesh(const ScanDescription& scan, const VertexGrid& grid, const PointPlanes& points,
             const PointPlanes& normals, const Quads& quads, bool rising, const EdgeNoise& noise,
             LayMeshScratch& scratch, Mesh& mesh);

}  // namespace facescan
