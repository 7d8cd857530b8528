#include "export/stl.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace facescan {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as in memory");

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetBytes = 50;

// Readers take a file that begins with "solid" for the text variant.
constexpr char kHeader[] = "facescan, binary STL; units: mm; axes: X right, Y down, Z from camera";
static_assert(sizeof(kHeader) <= kHeaderBytes);

using Vector = std::array<float, 3>;

Vector position(const Vertex& v) {
    return {v.x, v.y, v.z};
}

Vector facetNormal(const Vector& a, const Vector& b, const Vector& c) {
    const Vector u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Vector v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const Vector n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                      u[0] * v[1] - u[1] * v[0]};
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length == 0) return {0, 0, 0};  // as the format asks of a reader to work it out itself
    return {n[0] / length, n[1] / length, n[2] / length};
}

}  // namespace

void formatStl(const Mesh& mesh, std::string& out) {
    out.assign(kHeaderBytes + 4 + mesh.triangles.size() * kFacetBytes, '\0');
    char* cursor = out.data();
    std::memcpy(cursor, kHeader, sizeof(kHeader));
    const auto count = std::uint32_t(mesh.triangles.size());
    std::memcpy(cursor + kHeaderBytes, &count, sizeof(count));
    cursor += kHeaderBytes + sizeof(count);

    for (const Triangle& triangle : mesh.triangles) {
        std::array<Vector, 4> facet;  // the normal, then the corners
        for (int k = 0; k < 3; ++k) facet[k + 1] = position(mesh.vertices[triangle[k]]);
        facet[0] = facetNormal(facet[1], facet[2], facet[3]);
        std::memcpy(cursor, facet.data(), sizeof(facet));
        cursor += kFacetBytes;  // two attribute bytes stay zero
    }
}

}  // namespace facescan
