#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace facescan {

/// A vertex of the mesh, in millimetres in the scanner's frame (X right, Y down, Z away from the
/// camera). Nine floats without padding, in the order of mesh.ply.
struct Vertex {
    float x, y, z;
    float nx, ny, nz;  ///< unit normal, towards the camera
    float s, t;        ///< texture coordinates, 0 … 1, t upwards
    float quality;     ///< 0: filled in; above 0 to 1: measured
};
static_assert(sizeof(Vertex) == 9 * sizeof(float));

/// Three vertex indices, counter-clockwise seen from the camera.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh. Every vertex is used by at least one triangle.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
};

}  // namespace facescan
