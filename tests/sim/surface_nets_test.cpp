#include "sim/surface_nets.h"

#include <gtest/gtest.h>

#include <map>

namespace facescan::sim {
namespace {

const Eigen::Vector3f kCentre(1, -2, 3);

IsoSurface meshSphere(int threads) {
    const auto field = [](const Eigen::Vector3f& p) { return (p - kCentre).norm() - 10; };
    const Eigen::AlignedBox3f box(Eigen::Vector3f(-15, -15, -15), Eigen::Vector3f(15, 15, 15));
    return meshZeroSet(field, box, 0.7f, threads);
}

TEST(SurfaceNets, VerticesLieOnTheZeroSet) {
    const IsoSurface mesh = meshSphere(2);
    ASSERT_GT(mesh.positions.size(), 1000u);
    for (const Eigen::Vector3f& p : mesh.positions) EXPECT_NEAR((p - kCentre).norm(), 10, 0.001f);
}

TEST(SurfaceNets, ClosedBodyGivesAClosedSurfaceOfItsArea) {
    const IsoSurface mesh = meshSphere(2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
        const Eigen::Vector3f a = mesh.positions[t[0]];
        area += (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm() / 2;
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
    EXPECT_NEAR(area, 4 * 3.14159265 * 100, 0.005 * 1256.6);
}

TEST(SurfaceNets, TrianglesFaceOutwards) {
    const IsoSurface mesh = meshSphere(2);
    for (const Triangle& t : mesh.triangles) {
        const Eigen::Vector3f a = mesh.positions[t[0]];
        const Eigen::Vector3f normal = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
        EXPECT_GT(normal.dot(a - kCentre), 0);
    }
}

TEST(SurfaceNets, DoesNotDependOnTheNumberOfThreads) {
    const IsoSurface one = meshSphere(1), three = meshSphere(3);
    EXPECT_EQ(one.positions, three.positions);
    EXPECT_EQ(one.triangles, three.triangles);
}

}  // namespace
}  // namespace facescan::sim
