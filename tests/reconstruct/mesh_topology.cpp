#include "reconstruct/mesh_topology.h"

#include <algorithm>
#include <map>
#include <ostream>
#include <set>
#include <vector>

namespace facescan::test {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// How many triangles run along each edge, by direction.
std::map<Edge, int> directedEdges(const Mesh& mesh) {
    std::map<Edge, int> edges;
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    }
    return edges;
}

int runsAlong(const std::map<Edge, int>& edges, const Edge& edge) {
    const auto found = edges.find(edge);
    return found == edges.end() ? 0 : found->second;
}

void countEdgeFlaws(const Mesh& mesh, MeshFlaws& flaws) {
    const std::map<Edge, int> edges = directedEdges(mesh);
    for (const auto& [edge, runs] : edges) {
        flaws.edges_run_twice += runs > 1;
        const int back = runsAlong(edges, {edge.second, edge.first});
        if (edge.first < edge.second || back == 0) flaws.crowded_edges += runs + back > 2;
    }
}

void countTriangleFlaws(const Mesh& mesh, MeshFlaws& flaws) {
    std::set<Triangle> seen;
    std::vector<bool> used(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
        Triangle sorted = t;
        std::sort(sorted.begin(), sorted.end());
        flaws.degenerate_triangles += sorted[0] == sorted[1] || sorted[1] == sorted[2];
        flaws.duplicate_triangles += !seen.insert(sorted).second;
        for (const std::uint32_t v : t) used.at(v) = true;
    }
    flaws.unused_vertices = int(std::count(used.begin(), used.end(), false));
}

/// The triangles at a vertex form one fan where the edges opposite to it are one connected line.
bool isOneFan(const std::vector<Edge>& opposite) {
    std::vector<std::uint32_t> reached{opposite.front().first};
    std::vector<Edge> rest = opposite;
    bool grew = true;
    while (grew) {
        grew = std::erase_if(rest, [&](const Edge& edge) {
                   const bool touches = std::count(reached.begin(), reached.end(), edge.first) ||
                                        std::count(reached.begin(), reached.end(), edge.second);
                   if (touches) reached.insert(reached.end(), {edge.first, edge.second});
                   return touches;
               }) > 0;
    }
    return rest.empty();
}

int countSplitVertices(const Mesh& mesh) {
    std::vector<std::vector<Edge>> opposite(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) opposite[t[k]].push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
    }
    return int(std::count_if(opposite.begin(), opposite.end(), [](const std::vector<Edge>& edges) {
        return !edges.empty() && !isOneFan(edges);
    }));
}

bool facesOrigin(const Vertex& a, const Vertex& b, const Vertex& c) {
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const double nx = uy * vz - uz * vy;
    const double ny = uz * vx - ux * vz;
    const double nz = ux * vy - uy * vx;
    return nx * a.x + ny * a.y + nz * a.z < 0;
}

}  // namespace

MeshFlaws findFlaws(const Mesh& mesh) {
    MeshFlaws flaws;
    countTriangleFlaws(mesh, flaws);
    countEdgeFlaws(mesh, flaws);
    flaws.vertices_of_several_fans = countSplitVertices(mesh);
    for (const Triangle& t : mesh.triangles) {
        flaws.seen_from_behind +=
            !facesOrigin(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    }
    return flaws;
}

int countBoundaryEdges(const Mesh& mesh) {
    const std::map<Edge, int> edges = directedEdges(mesh);
    return int(std::count_if(edges.begin(), edges.end(), [&](const auto& entry) {
        return runsAlong(edges, {entry.first.second, entry.first.first}) == 0;
    }));
}

void PrintTo(const MeshFlaws& flaws, std::ostream* out) {
    *out << flaws.unused_vertices << " unused vertices, " << flaws.degenerate_triangles
         << " degenerate and " << flaws.duplicate_triangles << " duplicate triangles, "
         << flaws.crowded_edges << " crowded edges, " << flaws.edges_run_twice
         << " edges run twice, " << flaws.vertices_of_several_fans << " vertices of several fans, "
         << flaws.seen_from_behind << " triangles from behind";
}

}  // namespace facescan::test
