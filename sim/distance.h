#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

/// Signed distances (negative inside) of simple bodies and their smooth unions, in mm. Those of
/// ellipsoids are first-order approximations: exact at the surface, right in sign.
/// Source: I. Quilez, "distance functions" and "smooth minimum" (iquilezles.org).
namespace facescan::sim::distance {

using Point = Eigen::Vector3f;

inline float sphere(const Point& p, const Point& centre, float radius) {
    return (p - centre).norm() - radius;
}

inline float ellipsoid(const Point& p, const Point& centre, const Point& radii) {
    const Point q = (p - centre).cwiseQuotient(radii);
    const float k0 = q.norm();
    const float k1 = q.cwiseQuotient(radii).norm();
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

/// A ball that moves from `a` to `b` while its radius goes from `ra` to `rb`.
inline float taperedCapsule(const Point& p, const Point& a, const Point& b, float ra, float rb) {
    const Point ab = b - a;
    const float h = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0f, 1.0f);
    return (p - a - ab * h).norm() - (ra + (rb - ra) * h);
}

/// Union, rounded where the two are nearly as far: by k/4 at most.
inline float smoothUnion(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k / 4;
}

/// Intersection, rounded likewise.
inline float smoothIntersection(float a, float b, float k) {
    return -smoothUnion(-a, -b, k);
}

/// `a` without `b`, rounded likewise.
inline float smoothCut(float a, float b, float k) {
    return smoothIntersection(a, -b, k);
}

}  // namespace facescan::sim::distance
