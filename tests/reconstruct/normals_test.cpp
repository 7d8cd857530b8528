#include "reconstruct/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace facescan {
namespace {

/// A regular mesh of a height field over a square of ±20 mm, counter-clockwise seen from above
/// (from smaller Z).
Mesh heightField(const std::function<double(double, double)>& height) {
    constexpr int kSide = 41;
    Mesh mesh;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            const double x = i - 20;
            const double y = j - 20;
            Vertex vertex{};
            vertex.x = float(x);
            vertex.y = float(y);
            vertex.z = float(height(x, y));
            mesh.vertices.push_back(vertex);
        }
    }
    for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
        for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
            const std::uint32_t a = j * kSide + i;
            mesh.triangles.push_back({a, a + kSide, a + kSide + 1});
            mesh.triangles.push_back({a, a + kSide + 1, a + 1});
        }
    }
    return mesh;
}

TEST(Normals, OfAPlaneAreThePlanes) {
    Mesh mesh = heightField([](double x, double y) { return 400 + 0.3 * x - 0.2 * y; });
    addNormals(mesh);
    const double length = std::sqrt(0.3 * 0.3 + 0.2 * 0.2 + 1);
    for (const Vertex& v : mesh.vertices) {
        EXPECT_NEAR(v.nx, 0.3 / length, 1e-4);
        EXPECT_NEAR(v.ny, -0.2 / length, 1e-4);
        EXPECT_NEAR(v.nz, -1 / length, 1e-4) << "towards the camera";
    }
}

TEST(Normals, OfASphereAreItsRadii) {
    constexpr double kRadius = 60;
    Mesh mesh = heightField(
        [](double x, double y) { return 460 - std::sqrt(kRadius * kRadius - x * x - y * y); });
    addNormals(mesh);
    for (const Vertex& v : mesh.vertices) {
        if (std::abs(v.x) > 18 || std::abs(v.y) > 18) continue;
        const double cosine = (v.nx * v.x + v.ny * v.y + v.nz * (v.z - 460)) / kRadius;
        EXPECT_GT(cosine, std::cos(0.5 * 3.14159 / 180)) << "half a degree";
    }
}

TEST(Normals, AreOfUnitLength) {
    Mesh mesh = heightField([](double x, double y) { return 400 + std::sin(x) * std::cos(y); });
    addNormals(mesh);
    for (const Vertex& v : mesh.vertices) {
        EXPECT_NEAR(v.nx * v.nx + v.ny * v.ny + v.nz * v.nz, 1, 1e-5);
    }
}

TEST(Normals, ReplaceOlderOnes) {
    Mesh mesh = heightField([](double, double) { return 400.0; });
    for (Vertex& v : mesh.vertices) v.nx = 5;
    addNormals(mesh);
    EXPECT_EQ(mesh.vertices.front().nx, 0);
    EXPECT_EQ(mesh.vertices.front().nz, -1);
}

}  // namespace
}  // namespace facescan
