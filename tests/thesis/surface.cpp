#include "thesis/surface.h"

#include <algorithm>
#include <cmath>

namespace facescan::thesis {

double distance(const SpacePoint& a, const SpacePoint& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

double doubleArea(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
}

void keepVertices(const std::vector<bool>& keep, Surface& surface) {
    std::vector<std::uint32_t> index_of(surface.vertices.size());
    std::vector<SurfaceVertex> kept;
    for (std::size_t i = 0; i < keep.size(); ++i) {
        index_of[i] = std::uint32_t(kept.size());
        if (keep[i]) kept.push_back(surface.vertices[i]);
    }
    surface.vertices = std::move(kept);

    std::erase_if(surface.faces, [&](const Triangle& face) {
        return !std::all_of(face.begin(), face.end(), [&](std::uint32_t v) { return keep[v]; });
    });
    for (Triangle& face : surface.faces) {
        for (std::uint32_t& vertex : face) vertex = index_of[vertex];
    }
}

void dropUnusedVertices(Surface& surface) {
    std::vector<bool> used(surface.vertices.size());
    for (const Triangle& face : surface.faces) {
        for (std::uint32_t vertex : face) used[vertex] = true;
    }
    keepVertices(used, surface);
}

}  // namespace facescan::thesis
