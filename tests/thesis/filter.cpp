#include "thesis/filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace facescan::thesis {

namespace {

template <class Predicate>
void keepWhere(const Predicate& predicate, Surface& surface) {
    std::vector<bool> keep;
    for (const SurfaceVertex& vertex : surface.vertices) keep.push_back(predicate(vertex));
    keepVertices(keep, surface);
}

bool follow(const LineLimits& limits, const SurfaceVertex& a, const SurfaceVertex& b) {
    const double gap = std::hypot(a.image.x - b.image.x, a.image.y - b.image.y);
    return a.line == b.line && gap <= limits.max_gap_px &&
           std::abs(a.place.z - b.place.z) <= limits.max_depth_gap_mm;
}

double longestEdge(const Surface& surface, const Triangle& face) {
    const auto& vertices = surface.vertices;
    const SpacePoint& a = vertices[face[0]].place;
    const SpacePoint& b = vertices[face[1]].place;
    const SpacePoint& c = vertices[face[2]].place;
    return std::max({distance(a, b), distance(b, c), distance(c, a)});
}

}  // namespace

void dropLonely(const LineLimits& limits, Surface& surface) {
    const auto& vertices = surface.vertices;
    std::vector<bool> keep(vertices.size(), false);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        if (follow(limits, vertices[i - 1], vertices[i])) keep[i - 1] = keep[i] = true;
    }
    keepVertices(keep, surface);
}

void dropBorder(const Rect& image, double margin_px, Surface& surface) {
    const auto inside = [&](double value, int first, int size) {
        return value >= first + margin_px && value <= first + size - 1 - margin_px;
    };
    keepWhere(
        [&](const SurfaceVertex& vertex) {
            return inside(vertex.image.x, image.x, image.width) &&
                   inside(vertex.image.y, image.y, image.height);
        },
        surface);
}

void dropOutOfRange(double min_mm, double max_mm, Surface& surface) {
    keepWhere(
        [&](const SurfaceVertex& vertex) {
            return vertex.place.z >= min_mm && vertex.place.z <= max_mm;
        },
        surface);
}

void dropLongFaces(double ratio, Surface& surface) {
    std::vector<double> longest;
    for (const Triangle& face : surface.faces) longest.push_back(longestEdge(surface, face));
    const double sum = std::accumulate(longest.begin(), longest.end(), 0.0);
    const double limit = ratio * sum / double(longest.size());
    std::erase_if(surface.faces,
                  [&](const Triangle& face) { return longestEdge(surface, face) >= limit; });
}

}  // namespace facescan::thesis
