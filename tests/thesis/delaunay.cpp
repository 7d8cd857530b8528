#include "thesis/delaunay.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace facescan::thesis {

namespace {

/// A run of Qhull and what it holds.
class Qhull {
public:
    Qhull() { qh_zero(&state_, nullptr); }
    ~Qhull() {
        qh_freeqhull(&state_, !qh_ALL);
        int long_blocks = 0;
        int long_bytes = 0;
        qh_memfreeshort(&state_, &long_blocks, &long_bytes);
    }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    /// Triangulates points of two coordinates each.
    void triangulate(std::vector<double>& coordinates) {
        // Qbb scales, Qt cuts polygons of points on one circle into triangles, Qz adds a point far
        // away that helps where many points lie on one circle; Pp keeps it quiet.
        char command[] = "qhull d Qbb Qt Qc Qz Pp";
        const int points = int(coordinates.size() / 2);
        const int error =
            qh_new_qhull(&state_, 2, points, coordinates.data(), False, command, nullptr, nullptr);
        if (error != 0) throw std::runtime_error("Qhull cannot triangulate these points");
    }

    const facetT* facets() const { return state_.facet_list; }
    int pointId(pointT* point) { return qh_pointid(&state_, point); }

private:
    qhT state_{};
};

Triangle corners(Qhull& qhull, const facetT& facet) {
    Triangle corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto* vertex = static_cast<const vertexT*>(facet.vertices->e[i].p);
        corners[i] = std::uint32_t(qhull.pointId(vertex->point));
    }
    return corners;
}

bool onOneLine(std::span<const PlanePoint> points) {
    return points.size() < 3 || std::all_of(points.begin(), points.end(), [&](const auto& point) {
               return doubleArea(points[0], points[1], point) == 0;
           });
}

}  // namespace

std::vector<Triangle> delaunay(std::span<const PlanePoint> points) {
    if (onOneLine(points)) return {};
    std::vector<double> coordinates;
    for (const PlanePoint& point : points) {
        coordinates.push_back(point.x);
        coordinates.push_back(point.y);
    }

    const auto qhull = std::make_unique<Qhull>();
    qhull->triangulate(coordinates);
    std::vector<Triangle> triangles;
    for (const facetT* facet = qhull->facets(); facet && facet->next; facet = facet->next) {
        if (facet->upperdelaunay) continue;
        Triangle face = corners(*qhull, *facet);
        const double area = doubleArea(points[face[0]], points[face[1]], points[face[2]]);
        if (area == 0) continue;
        if (area < 0) std::swap(face[1], face[2]);
        triangles.push_back(face);
    }
    return triangles;
}

}  // namespace facescan::thesis
