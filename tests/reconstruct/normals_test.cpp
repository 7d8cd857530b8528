#include "reconstruct/normals.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "reconstruct/grids.h"
#include "reconstruct/tessellate.h"

namespace facescan {
namespace {

constexpr int kSide = 41;

/// The points of a height field over a square of ±20 mm, all cells of which are measured.
class HeightField {
public:
    explicit HeightField(const std::function<double(double, double)>& height)
        : grid_(test::makeGrid(kSide + 1, kSide, [](int code, int) { return 4.0 * code; })) {
        points_.resize(grid_.size() + VertexGrid::kBeyond);
        for (int code = 1; code <= kSide; ++code) {
            for (int column = 0; column < kSide; ++column) {
                const double x = column - 20;
                const double y = code - 21;
                points_.set(grid_.index(code, column), {float(x), float(y), float(height(x, y))});
            }
        }
        tessellate({}, grid_, points_, true, scratch_, quads_);
    }

    /// Calls check(point, normal) for each vertex.
    void forEachNormal(const std::function<void(const Point&, const Point&)>& check) {
        // A rising code turns triangles clockwise.
        computeNormals(grid_, points_, quads_, -1, normal_scratch_, normals_);
        for (std::size_t i = grid_.columns; i < grid_.size(); ++i) check(points_[i], normals_[i]);
    }

    void cut(int code, int column) {
        const std::size_t i = grid_.index(code, column);
        quads_.first[i] = quads_.second[i] = 0;
    }

    const VertexGrid& grid() const { return grid_; }
    const Quads& quads() const { return quads_; }

private:
    VertexGrid grid_;
    PointPlanes points_;
    TessellateScratch scratch_;
    Quads quads_;
    NormalScratch normal_scratch_;
    PointPlanes normals_;
};

TEST(Normals, OfAPlaneAreThePlanes) {
    HeightField field([](double x, double y) { return 400 + 0.3 * x - 0.2 * y; });
    const double length = std::sqrt(0.3 * 0.3 + 0.2 * 0.2 + 1);
    field.forEachNormal([&](const Point&, const Point& n) {
        EXPECT_NEAR(n.x, 0.3 / length, 1e-4);
        EXPECT_NEAR(n.y, -0.2 / length, 1e-4);
        EXPECT_NEAR(n.z, -1 / length, 1e-4) << "towards the camera";
    });
}

TEST(Normals, OfASphereAreItsRadii) {
    constexpr double kRadius = 60;
    HeightField field(
        [](double x, double y) { return 460 - std::sqrt(kRadius * kRadius - x * x - y * y); });
    field.forEachNormal([&](const Point& p, const Point& n) {
        if (std::abs(p.x) > 18 || std::abs(p.y) > 18) return;
        const double cosine = (n.x * p.x + n.y * p.y + n.z * (p.z - 460)) / kRadius;
        EXPECT_GT(cosine, std::cos(0.5 * 3.14159 / 180)) << "half a degree";
    });
}

TEST(Normals, AreOfUnitLength) {
    HeightField field([](double x, double y) { return 400 + std::sin(x) * std::cos(y); });
    field.forEachNormal([](const Point&, const Point& n) {
        EXPECT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1, 1e-5);
    });
}

TEST(Normals, AreTheSumOfTheTrianglesThatMeetThere) {
    HeightField field([](double x, double y) { return 400 + 2 * std::sin(x) + std::cos(2 * y); });
    for (const auto& [code, column] : {std::pair{9, 9}, {20, 0}, {30, 12}}) field.cut(code, column);
    const VertexGrid& grid = field.grid();
    const Quads& quads = field.quads();
    std::vector<Eigen::Vector3d> points(grid.size(), Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> expected(grid.size(), Eigen::Vector3d::Zero());
    field.forEachNormal([&, i = std::size_t(grid.columns)](const Point& p, const Point&) mutable {
        points[i++] = {p.x, p.y, p.z};
    });
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Eigen::Vector3d normal = (points[c] - points[a]).cross(points[b] - points[a]);
        for (const std::size_t i : {a, b, c}) expected[i] += normal;
    };
    for (std::size_t nw = grid.columns; nw + grid.columns + 1 < grid.size(); ++nw) {
        const std::size_t sw = nw + grid.columns;
        const bool falling = quads.falling[nw];
        if (quads.first[nw]) add(nw, nw + 1, falling ? sw + 1 : sw);
        if (quads.second[nw]) add(falling ? nw : nw + 1, sw + 1, sw);
    }
    field.forEachNormal([&, i = std::size_t(grid.columns)](const Point&, const Point& n) mutable {
        const Eigen::Vector3d normal = expected[i++].normalized();
        EXPECT_LT((Eigen::Vector3d(n.x, n.y, n.z) - normal).norm(), 1e-5);
    });
}

}  // namespace
}  // namespace facescan
