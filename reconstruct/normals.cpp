#include "reconstruct/normals.h"

#include <cmath>

namespace facescan {

void addNormals(Mesh& mesh) {
    for (Vertex& v : mesh.vertices) v.nx = v.ny = v.nz = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vertex& a = mesh.vertices[triangle[0]];
        const Vertex& b = mesh.vertices[triangle[1]];
        const Vertex& c = mesh.vertices[triangle[2]];
        const float ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const float vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
        // The cross product's length is twice the area.
        const float nx = uy * vz - uz * vy;
        const float ny = uz * vx - ux * vz;
        const float nz = ux * vy - uy * vx;
        for (const std::uint32_t index : triangle) {
            Vertex& v = mesh.vertices[index];
            v.nx += nx;
            v.ny += ny;
            v.nz += nz;
        }
    }
    for (Vertex& v : mesh.vertices) {
        const float length = std::sqrt(v.nx * v.nx + v.ny * v.ny + v.nz * v.nz);
        if (length > 0) {
            v.nx /= length;
            v.ny /= length;
            v.nz /= length;
        } else {
            v.nz = -1;
        }
    }
}

}  // namespace facescan
