#pragma once

#include "thesis/surface.h"

namespace facescan::thesis {

/// A plane 400 mm away, a vertex every millimetre and every pixel; line by line, two faces a
/// square. The vertex of column x and row y has the index x · rows + y.
inline Surface flatGrid(int columns, int rows) {
    Surface surface;
    for (int x = 0; x < columns; ++x) {
        for (int y = 0; y < rows; ++y) {
            surface.vertices.push_back({{double(x), double(y)}, {double(x), double(y), 400}, x});
        }
    }
    for (int x = 0; x + 1 < columns; ++x) {
        for (int y = 0; y + 1 < rows; ++y) {
            const auto corner = std::uint32_t(x * rows + y);
            const auto right = std::uint32_t(corner + rows);
            surface.faces.push_back({corner, corner + 1, right + 1});
            surface.faces.push_back({corner, right + 1, right});
        }
    }
    return surface;
}

/// The surface without the vertex of that index.
inline Surface without(std::size_t index, Surface surface) {
    std::vector<bool> keep(surface.vertices.size(), true);
    keep[index] = false;
    keepVertices(keep, surface);
    return surface;
}

inline double imageArea(const Surface& surface) {
    double area = 0;
    for (const auto& [a, b, c] : surface.faces) {
        area += doubleArea(surface.vertices[a].image, surface.vertices[b].image,
                           surface.vertices[c].image) /
                2;
    }
    return area;
}

}  // namespace facescan::thesis
