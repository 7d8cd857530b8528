#include "thesis/delaunay.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>

namespace facescan::thesis {
namespace {

/// Above 0 where `p` lies inside the circle through a, b, c, counter-clockwise as one looks at the
/// image. Exact for whole coordinates below 1000.
std::int64_t inCircle(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c,
                      const PlanePoint& p) {
    struct Lifted {
        std::int64_t x, y, square;
    };
    const auto lifted = [&](const PlanePoint& q) {
        const auto x = std::int64_t(q.x - p.x);
        const auto y = std::int64_t(p.y - q.y);
        return Lifted{x, y, x * x + y * y};
    };
    const Lifted i = lifted(a);
    const Lifted j = lifted(b);
    const Lifted k = lifted(c);
    return i.x * (j.y * k.square - k.y * j.square) - i.y * (j.x * k.square - k.x * j.square) +
           i.square * (j.x * k.y - k.x * j.y);
}

void expectEmptyCircles(const std::vector<PlanePoint>& points,
                        const std::vector<Triangle>& triangles) {
    for (const auto& [a, b, c] : triangles) {
        ASSERT_GT(doubleArea(points[a], points[b], points[c]), 0);
        for (const PlanePoint& point : points) {
            ASSERT_LE(inCircle(points[a], points[b], points[c], point), 0);
        }
    }
}

double coveredArea(const std::vector<PlanePoint>& points, const std::vector<Triangle>& triangles) {
    double area = 0;
    for (const auto& [a, b, c] : triangles) area += doubleArea(points[a], points[b], points[c]) / 2;
    return area;
}

std::vector<PlanePoint> lattice(int columns, int rows) {
    std::vector<PlanePoint> points;
    for (int x = 0; x < columns; ++x) {
        for (int y = 0; y < rows; ++y) points.push_back({double(x), double(y)});
    }
    return points;
}

TEST(ThesisDelaunay, NoPointLiesInsideTheCircleOfATriangle) {
    std::mt19937 random(7);
    std::set<std::pair<int, int>> places;
    while (places.size() < 400) places.emplace(random() % 480, random() % 754);
    std::vector<PlanePoint> points;
    points.reserve(places.size());
    for (const auto& [x, y] : places) points.push_back({double(x), double(y)});
    expectEmptyCircles(points, delaunay(points));
}

TEST(ThesisDelaunay, CoversALatticeWhereEveryFourNeighboursLieOnOneCircle) {
    const std::vector<PlanePoint> points = lattice(24, 31);
    const std::vector<Triangle> triangles = delaunay(points);
    EXPECT_EQ(triangles.size(), 2u * 23 * 30);
    EXPECT_EQ(coveredArea(points, triangles), 23 * 30);
    expectEmptyCircles(points, triangles);
}

TEST(ThesisDelaunay, CoversTheConvexHull) {
    std::vector<PlanePoint> points = lattice(5, 5);
    points.push_back({200, 2});
    // The square, and the triangle from its right edge to the point far away.
    EXPECT_EQ(coveredArea(points, delaunay(points)), 16 + 4 * 196 / 2);
}

TEST(ThesisDelaunay, TrianglesRunCounterClockwiseAsOneLooksAtTheImage) {
    // y points down: from the left to the lower middle to the right.
    const std::vector<PlanePoint> points = {{0, 0}, {2, 3}, {4, 0}};
    std::vector<Triangle> triangles = delaunay(points);
    ASSERT_EQ(triangles.size(), 1u);
    std::rotate(triangles[0].begin(), std::find(triangles[0].begin(), triangles[0].end(), 0u),
                triangles[0].end());
    EXPECT_EQ(triangles[0], (Triangle{0, 1, 2}));
}

TEST(ThesisDelaunay, PointsOnALineHaveNoTriangles) {
    EXPECT_TRUE(delaunay(lattice(1, 9)).empty());
    EXPECT_TRUE(delaunay(lattice(1, 2)).empty());
    EXPECT_TRUE(delaunay({}).empty());
}

}  // namespace
}  // namespace facescan::thesis
