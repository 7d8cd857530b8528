#include "sim/camera.h"

#include <Eigen/LU>

namespace facescan::sim {

namespace {

/// The distorted image of the undistorted point (a, b), both on the plane Z = 1.
Eigen::Vector2d distort(const Camera& camera, const Eigen::Vector2d& point) {
    const double a = point.x(), b = point.y();
    const double r2 = a * a + b * b;
    const double q = 1 + (camera.k1 + camera.k2 * r2) * r2;
    return {a * q + 2 * camera.p1 * a * b + camera.p2 * (r2 + 2 * a * a),
            b * q + 2 * camera.p2 * a * b + camera.p1 * (r2 + 2 * b * b)};
}

Eigen::Matrix2d distortionJacobian(const Camera& camera, const Eigen::Vector2d& point) {
    const double a = point.x(), b = point.y();
    const double r2 = a * a + b * b;
    const double q = 1 + (camera.k1 + camera.k2 * r2) * r2;
    const double dq = 2 * camera.k1 + 4 * camera.k2 * r2;
    const double mixed = dq * a * b + 2 * camera.p1 * a + 2 * camera.p2 * b;
    Eigen::Matrix2d jacobian;
    jacobian << q + dq * a * a + 2 * camera.p1 * b + 6 * camera.p2 * a, mixed,  //
        mixed, q + dq * b * b + 2 * camera.p2 * a + 6 * camera.p1 * b;
    return jacobian;
}

}  // namespace

Eigen::Vector2d Camera::project(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d d = distort(*this, point.head<2>() / point.z());
    return {fx * d.x() + cx, fy * d.y() + cy};
}

Eigen::Vector3d Camera::ray(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d distorted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
    Eigen::Vector2d point = distorted;
    // Newton's method converges quadratically: 0.1 px after the start, rounding after three steps.
    for (int step = 0; step < 4; ++step) {
        point -= distortionJacobian(*this, point).inverse() * (distort(*this, point) - distorted);
    }
    return {point.x(), point.y(), 1};
}

}  // namespace facescan::sim
