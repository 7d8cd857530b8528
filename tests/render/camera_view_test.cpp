#include "render/camera_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "render/meshes.h"

namespace facescan {
namespace {

constexpr float kPortrait = 2.0f / 3;

/// Where a point (mm) appears: −1 … 1 from left to right, from bottom to top, from near to far.
Eigen::Vector3f seen(const CameraView& camera, const Eigen::Vector3f& point) {
    return (camera.projection * camera.view * point.homogeneous()).hnormalized();
}

Eigen::AlignedBox3f seenBox(const CameraView& camera, const Mesh& mesh) {
    Eigen::AlignedBox3f box;
    for (const Vertex& v : mesh.vertices) box.extend(seen(camera, {v.x, v.y, v.z}));
    return box;
}

/// The eye's place in the scanner's frame.
Eigen::Vector3f eye(const CameraView& camera) {
    return camera.view.inverse().topRightCorner<3, 1>();
}

TEST(CameraView, FromTheScannerXIsRightAndYIsDown) {
    const CameraView camera = frameMesh(testing::squareFacingTheScanner(100, 400), {}, kPortrait);
    EXPECT_GT(seen(camera, {20, 0, 400}).x(), 0);
    EXPECT_LT(seen(camera, {0, 20, 400}).y(), 0);
    EXPECT_NEAR(seen(camera, {0, 0, 400}).head<2>().norm(), 0, 1e-6);
}

TEST(CameraView, WithoutATurnTheEyeIsTheScanner) {
    const CameraView camera = frameMesh(testing::squareFacingTheScanner(100, 400), {}, kPortrait);
    EXPECT_NEAR(eye(camera).norm(), 0, 1e-3);
}

TEST(CameraView, TurningRightAndUpTakesTheEyeThereAtTheSameDistance) {
    const Mesh mesh = testing::squareFacingTheScanner(100, 400);
    const CameraView camera = frameMesh(mesh, {.right_deg = 30, .up_deg = 10}, kPortrait);
    EXPECT_NEAR(eye(camera).x(), 400 * std::sin(M_PI / 6) * std::cos(M_PI / 18), 0.01);
    EXPECT_NEAR(eye(camera).y(), -400 * std::sin(M_PI / 18), 0.01);
    EXPECT_NEAR((eye(camera) - Eigen::Vector3f(0, 0, 400)).norm(), 400, 0.01);
}

TEST(CameraView, DoesNotMirror) {
    const CameraView camera =
        frameMesh(testing::sphereCap(80, 400), {.right_deg = 25, .up_deg = -12}, kPortrait);
    const Eigen::Matrix3f rotation = camera.view.topLeftCorner<3, 3>();
    EXPECT_NEAR(rotation.determinant(), 1, 1e-5);
    EXPECT_TRUE(rotation.isUnitary(1e-5f));
}

TEST(CameraView, FitsTheMeshIntoTheMiddleUpToTheMargin) {
    for (const float aspect : {0.5f, 1.0f, 2.0f}) {
        for (const Viewpoint viewpoint : {Viewpoint{}, Viewpoint{25, 10}, Viewpoint{-80, 60}}) {
            Mesh mesh = testing::sphereCap(80, 400);
            for (Vertex& vertex : mesh.vertices) vertex.x += 60;
            const auto box = seenBox(frameMesh(mesh, viewpoint, aspect, 0.1f), mesh);
            EXPECT_NEAR(std::max(box.sizes().x(), box.sizes().y()), 2 * 0.8f, 1e-3);
            EXPECT_NEAR(box.center().head<2>().norm(), 0, 1e-3);
        }
    }
}

TEST(CameraView, KeepsTheMeshBetweenNearAndFarPlane) {
    const Mesh mesh = testing::sphereCap(80, 400);
    const CameraView camera = frameMesh(mesh, {.right_deg = 20}, kPortrait);
    const auto box = seenBox(camera, mesh);
    EXPECT_GT(box.min().z(), -1);
    EXPECT_LT(box.max().z(), 1);
    EXPECT_LT(seen(camera, {0, 0, 320}).z(), seen(camera, {0, 0, 390}).z());
}

TEST(CameraView, SquaresStaySquare) {
    const CameraView camera = frameMesh(testing::squareFacingTheScanner(100, 400), {}, kPortrait);
    const Eigen::Vector3f corner = seen(camera, {50, -50, 400});
    EXPECT_NEAR(corner.x() * kPortrait, corner.y(), 1e-5);
}

TEST(CameraView, AMeshAroundTheScannerIsSeenFromOutside) {
    const Mesh mesh = testing::sphereCap(100, 0);
    const CameraView camera = frameMesh(mesh, {}, kPortrait);
    for (const Vertex& v : mesh.vertices) {
        EXPECT_LT((camera.view * Eigen::Vector4f(v.x, v.y, v.z, 1)).z(), 0);
    }
}

TEST(CameraView, VerticesThatAreNotFiniteDoNotCount) {
    Mesh mesh = testing::squareFacingTheScanner(100, 400);
    const CameraView expected = frameMesh(mesh, {}, kPortrait);
    mesh.vertices.push_back(mesh.vertices.front());
    mesh.vertices.back().y = std::numeric_limits<float>::quiet_NaN();
    mesh.vertices.push_back(mesh.vertices.front());
    mesh.vertices.back().z = std::numeric_limits<float>::infinity();
    const CameraView camera = frameMesh(mesh, {}, kPortrait);
    EXPECT_EQ(camera.view, expected.view);
    EXPECT_EQ(camera.projection, expected.projection);
}

TEST(CameraView, NothingAndASinglePointGiveAFiniteView) {
    Mesh mesh;
    for (int vertices = 0; vertices < 2; ++vertices) {
        const CameraView camera = frameMesh(mesh, {.right_deg = 20}, kPortrait);
        EXPECT_TRUE(camera.view.allFinite());
        EXPECT_TRUE(camera.projection.allFinite());
        mesh.vertices.push_back({10, 20, 400, 0, 0, -1, 0, 0, 1});
    }
}

}  // namespace
}  // namespace facescan
