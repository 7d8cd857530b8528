#pragma once

#include <cmath>
#include <numbers>

#include "reconstruct/image.h"
#include "reconstruct/mesh.h"

namespace facescan::testing {

/// A square grid of `cells` × `cells` quads that faces the scanner: `size` mm wide, its middle on
/// the lens's axis at `depth` mm, the texture laid over it once.
inline Mesh squareFacingTheScanner(float size, float depth, float quality = 1, int cells = 1) {
    Mesh mesh;
    const std::uint32_t side = cells + 1;
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const float right = float(column) / float(cells);
            const float down = float(row) / float(cells);
            mesh.vertices.push_back({(right - 0.5f) * size, (down - 0.5f) * size, depth, 0, 0, -1,
                                     right, 1 - down, quality});
        }
    }
    for (std::uint32_t row = 0; row + 1 < side; ++row) {
        for (std::uint32_t column = 0; column + 1 < side; ++column) {
            const std::uint32_t corner = row * side + column;
            mesh.triangles.push_back({corner, corner + side, corner + 1});
            mesh.triangles.push_back({corner + 1, corner + side, corner + side + 1});
        }
    }
    return mesh;
}

/// The half of a sphere that faces the scanner, but for its outermost ring: of `radius` mm, its
/// middle on the lens's axis at `depth` mm.
inline Mesh sphereCap(float radius, float depth, int rings = 40) {
    Mesh mesh = squareFacingTheScanner(2, depth, 1, rings);
    for (Vertex& vertex : mesh.vertices) {
        // A square's point at distance d (in the maximum norm) goes to the sphere's angle d × 85°.
        const float d = std::max(std::abs(vertex.x), std::abs(vertex.y));
        const float length = std::hypot(vertex.x, vertex.y);
        const float angle = d * 85 * std::numbers::pi_v<float> / 180;
        const float across = length > 0 ? std::sin(angle) / length : 0;
        vertex.nx = vertex.x * across;
        vertex.ny = vertex.y * across;
        vertex.nz = -std::cos(angle);
        vertex.x = radius * vertex.nx;
        vertex.y = radius * vertex.ny;
        vertex.z = depth + radius * vertex.nz;
    }
    return mesh;
}

/// Places `more` behind `mesh` in the order of drawing.
inline void append(Mesh& mesh, const Mesh& more) {
    const std::uint32_t first = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const Triangle& t : more.triangles) {
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
}

/// Four quarters of one grey each.
inline GreyImage quarters(std::uint8_t top_left, std::uint8_t top_right, std::uint8_t bottom_left,
                          std::uint8_t bottom_right, int width = 64, int height = 64) {
    GreyImage image{width, height, {}};
    image.pixels.reserve(std::size_t(width) * height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool left = x < width / 2;
            const bool top = y < height / 2;
            image.pixels.push_back(top ? (left ? top_left : top_right)
                                       : (left ? bottom_left : bottom_right));
        }
    }
    return image;
}

inline GreyImage plainTexture(std::uint8_t grey) {
    return quarters(grey, grey, grey, grey, 4, 4);
}

}  // namespace facescan::testing
