#include "render/camera_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace facescan {
namespace {

using Box2 = Eigen::AlignedBox2f;
using Box3 = Eigen::AlignedBox3f;

Eigen::Vector3f position(const Vertex& vertex) {
    return {vertex.x, vertex.y, vertex.z};
}

Box3 boundingBox(const Mesh& mesh) {
    Box3 box;
    for (const Vertex& vertex : mesh.vertices) {
        if (position(vertex).allFinite()) box.extend(position(vertex));
    }
    return box.isEmpty() ? Box3(Eigen::Vector3f(-1, -1, 399), Eigen::Vector3f(1, 1, 401)) : box;
}

/// Rows: the eye's axes (right, up, backwards) in the scanner's frame.
Eigen::Matrix3f eyeAxes(const Viewpoint& viewpoint) {
    constexpr float kRadian = std::numbers::pi_v<float> / 180;
    const Eigen::Matrix3f turn =
        (Eigen::AngleAxisf(-viewpoint.right_deg * kRadian, Eigen::Vector3f::UnitY()) *
         Eigen::AngleAxisf(-viewpoint.up_deg * kRadian, Eigen::Vector3f::UnitX()))
            .toRotationMatrix();
    const Eigen::Vector3f scanner_to_eye(1, -1, -1);
    return scanner_to_eye.asDiagonal() * turn.transpose();
}

Eigen::Matrix4f lookAt(const Box3& box, const Viewpoint& viewpoint) {
    const Eigen::Vector3f middle = box.center();
    const float radius = box.diagonal().norm() / 2;
    // No vertex comes behind the eye, wherever a mesh from elsewhere lies.
    const float distance = std::max({middle.norm(), 1.5f * radius, 1.0f});

    const Eigen::Matrix3f axes = eyeAxes(viewpoint);
    Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
    view.topLeftCorner<3, 3>() = axes;
    view.topRightCorner<3, 1>() = Eigen::Vector3f(0, 0, -distance) - axes * middle;
    return view;
}

/// What the eye sees: tangents to the right and up, and depths (mm).
struct Extents {
    Box2 tangents;
    Eigen::AlignedBox1f depths;
};

Extents extentsSeen(const Mesh& mesh, const Eigen::Matrix4f& view) {
    Extents extents;
    for (const Vertex& vertex : mesh.vertices) {
        if (!position(vertex).allFinite()) continue;
        const Eigen::Vector3f seen =
            view.topLeftCorner<3, 3>() * position(vertex) + view.topRightCorner<3, 1>();
        extents.tangents.extend(seen.head<2>() / -seen.z());
        extents.depths.extend(Eigen::Matrix<float, 1, 1>(-seen.z()));
    }
    if (extents.tangents.isEmpty()) {
        extents.tangents = Box2(Eigen::Vector2f::Zero());
        extents.depths = Eigen::AlignedBox1f(Eigen::Matrix<float, 1, 1>(-view(2, 3)));
    }
    return extents;
}

/// Half the window, in tangents: the smallest of this aspect around the extents and their margin.
Eigen::Vector2f halfWindow(const Box2& tangents, float aspect, float margin) {
    constexpr float kSmallest = 1e-3f;
    const Eigen::Vector2f half = tangents.sizes() / (2 - 4 * margin);
    const float half_height = std::max({half.y(), half.x() / aspect, kSmallest});
    return {half_height * aspect, half_height};
}

Eigen::Matrix4f projectionOnto(const Extents& extents, float aspect, float margin) {
    const Eigen::Vector2f middle = extents.tangents.center();
    const Eigen::Vector2f half = halfWindow(extents.tangents, aspect, margin);
    const float near = extents.depths.min().x() * 0.98f;
    const float far = extents.depths.max().x() * 1.02f;

    Eigen::Matrix4f projection = Eigen::Matrix4f::Zero();
    projection(0, 0) = 1 / half.x();
    projection(0, 2) = middle.x() / half.x();
    projection(1, 1) = 1 / half.y();
    projection(1, 2) = middle.y() / half.y();
    projection(2, 2) = -(far + near) / (far - near);
    projection(2, 3) = -2 * far * near / (far - near);
    projection(3, 2) = -1;
    return projection;
}

}  // namespace

CameraView frameMesh(const Mesh& mesh, const Viewpoint& viewpoint, float aspect, float margin) {
    CameraView camera;
    camera.view = lookAt(boundingBox(mesh), viewpoint);
    camera.projection = projectionOnto(extentsSeen(mesh, camera.view), aspect, margin);
    return camera;
}

}  // namespace facescan
