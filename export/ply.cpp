#include "export/ply.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace facescan {
namespace {

static_assert(std::endian::native == std::endian::little, "the mesh is copied as it is in memory");

constexpr std::size_t kFaceBytes = 1 + sizeof(Triangle);  // the list's length, then the indices

std::string header(const Mesh& mesh) {
    return "ply\n"
           "format binary_little_endian 1.0\n"
           "comment made by facescan\n"
           "comment TextureFile " +
           std::string(kPlyTextureName) +
           "\n"
           "comment units: mm\n"
           "comment axes: X right, Y down, Z away from the camera, which is at the origin\n"
           "comment quality: 0 filled in, above 0 to 1 measured\n"
           "element vertex " +
           std::to_string(mesh.vertices.size()) +
           "\n"
           "property float x\n"
           "property float y\n"
           "property float z\n"
           "property float nx\n"
           "property float ny\n"
           "property float nz\n"
           "property float s\n"
           "property float t\n"
           "property float quality\n"
           "element face " +
           std::to_string(mesh.triangles.size()) +
           "\n"
           "property list uchar uint vertex_indices\n"
           "end_header\n";
}

void packFaces(const std::vector<Triangle>& triangles, char* out) {
    for (const Triangle& triangle : triangles) {
        out[0] = 3;
        std::memcpy(out + 1, triangle.data(), sizeof(Triangle));
        out += kFaceBytes;
    }
}

}  // namespace

void formatPly(const Mesh& mesh, std::string& out) {
    const std::string head = header(mesh);
    const std::size_t vertex_bytes = mesh.vertices.size() * sizeof(Vertex);
    const std::size_t face_bytes = mesh.triangles.size() * kFaceBytes;

    // Not cleared before: what is overwritten need not be filled with zeros.
    out.resize(head.size() + vertex_bytes + face_bytes);
    char* place = std::ranges::copy(head, out.data()).out;
    if (vertex_bytes > 0) std::memcpy(place, mesh.vertices.data(), vertex_bytes);
    packFaces(mesh.triangles, place + vertex_bytes);
}

}  // namespace facescan
