#include "thesis/fill_holes.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace facescan::thesis {

namespace {

using Loop = std::vector<std::uint32_t>;

/// The edges that have a face on one side only, in that face's direction: from, to.
std::multimap<std::uint32_t, std::uint32_t> boundaryEdges(const std::vector<Triangle>& faces) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& face : faces) {
        for (int i = 0; i < 3; ++i) edges.emplace(face[i], face[(i + 1) % 3]);
    }
    std::multimap<std::uint32_t, std::uint32_t> boundary;
    for (const auto& [from, to] : edges) {
        if (!edges.contains({to, from})) boundary.emplace(from, to);
    }
    return boundary;
}

bool isHole(const Surface& surface, const Loop& loop) {
    const PlanePoint& first = surface.vertices[loop.front()].image;
    double area = 0;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        area +=
            doubleArea(first, surface.vertices[loop[i]].image, surface.vertices[loop[i + 1]].image);
    }
    return area < 0;
}

SurfaceVertex middle(const Surface& surface, const Loop& loop) {
    SurfaceVertex mean;
    mean.line = -1;
    const double share = 1 / double(loop.size());
    for (const std::uint32_t index : loop) {
        const SurfaceVertex& vertex = surface.vertices[index];
        mean.image.x += share * vertex.image.x;
        mean.image.y += share * vertex.image.y;
        mean.place.x += share * vertex.place.x;
        mean.place.y += share * vertex.place.y;
        mean.place.z += share * vertex.place.z;
    }
    return mean;
}

}  // namespace

std::vector<Loop> boundaryLoops(const std::vector<Triangle>& faces) {
    auto edges = boundaryEdges(faces);
    std::vector<Loop> loops;
    while (!edges.empty()) {
        Loop path = {edges.begin()->first};
        for (auto edge = edges.begin(); edge != edges.end(); edge = edges.find(path.back())) {
            const std::uint32_t next = edge->second;
            edges.erase(edge);
            const auto visited = std::find(path.begin(), path.end(), next);
            if (visited == path.end()) {
                path.push_back(next);
            } else {
                loops.emplace_back(visited, path.end());
                path.erase(visited + 1, path.end());
            }
        }
    }
    return loops;
}

void fillHoles(Surface& surface) {
    for (const Loop& loop : boundaryLoops(surface.faces)) {
        if (!isHole(surface, loop)) continue;
        const auto centre = std::uint32_t(surface.vertices.size());
        surface.vertices.push_back(middle(surface, loop));
        for (std::size_t i = 0; i < loop.size(); ++i) {
            surface.faces.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
        }
    }
}

}  // namespace facescan::thesis
