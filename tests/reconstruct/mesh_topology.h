#pragma once

#include <iosfwd>

#include "reconstruct/mesh.h"

namespace facescan::test {

/// What is wrong with a mesh that should be a manifold with a boundary; all 0 where nothing is.
struct MeshFlaws {
    int unused_vertices = 0;
    int degenerate_triangles = 0;      ///< a vertex twice
    int duplicate_triangles = 0;       ///< the same three vertices, in any order
    int crowded_edges = 0;             ///< more than two triangles at an edge
    int edges_run_twice = 0;           ///< two triangles run along an edge in the same direction
    int vertices_of_several_fans = 0;  ///< triangles meet at a vertex without a common edge
    int seen_from_behind = 0;          ///< clockwise, seen from the origin

    friend bool operator==(const MeshFlaws&, const MeshFlaws&) = default;
};

/// Counts edges and corners, without regard to how the mesh was made.
MeshFlaws findFlaws(const Mesh& mesh);

/// The number of edges with a triangle on one side alone.
int countBoundaryEdges(const Mesh& mesh);

/// For GoogleTest's messages.
void PrintTo(const MeshFlaws& flaws, std::ostream* out);

}  // namespace facescan::test
