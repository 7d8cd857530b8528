#include "thesis/to_mesh.h"

#include <cmath>

namespace facescan::thesis {

namespace {

/// Normal of a face, as long as twice its area. It points to the side from which the face runs
/// counter-clockwise.
SpacePoint areaNormal(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
    const SpacePoint u = {b.x - a.x, b.y - a.y, b.z - a.z};
    const SpacePoint v = {c.x - a.x, c.y - a.y, c.z - a.z};
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

std::vector<SpacePoint> vertexNormals(const Surface& surface) {
    std::vector<SpacePoint> normals(surface.vertices.size());
    for (const Triangle& face : surface.faces) {
        const SpacePoint normal =
            areaNormal(surface.vertices[face[0]].place, surface.vertices[face[1]].place,
                       surface.vertices[face[2]].place);
        for (const std::uint32_t vertex : face) {
            normals[vertex].x += normal.x;
            normals[vertex].y += normal.y;
            normals[vertex].z += normal.z;
        }
    }
    for (SpacePoint& normal : normals) {
        const double length = distance(normal, {});
        normal = length > 0 ? SpacePoint{normal.x / length, normal.y / length, normal.z / length}
                            : SpacePoint{0, 0, -1};
    }
    return normals;
}

}  // namespace

Mesh toMesh(const Surface& surface, const Rect& image) {
    const std::vector<SpacePoint> normals = vertexNormals(surface);
    Mesh mesh;
    mesh.triangles = surface.faces;
    for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
        const SurfaceVertex& vertex = surface.vertices[i];
        mesh.vertices.push_back({
            .x = float(vertex.place.x),
            .y = float(vertex.place.y),
            .z = float(vertex.place.z),
            .nx = float(normals[i].x),
            .ny = float(normals[i].y),
            .nz = float(normals[i].z),
            .s = float((vertex.image.x - image.x + 0.5) / image.width),
            .t = float(1 - (vertex.image.y - image.y + 0.5) / image.height),
            .quality = vertex.line >= 0 ? 1.0f : 0.0f,
        });
    }
    return mesh;
}

}  // namespace facescan::thesis
