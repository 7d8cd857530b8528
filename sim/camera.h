#pragma once

#include <Eigen/Core>

namespace facescan::sim {

/// A pinhole camera with Brown's lens distortion, in the scanner's frame: centre at the origin, X
/// right, Y down, Z out of the lens. Pixel centres lie at whole numbers.
///
/// With a = X/Z, b = Y/Z, r² = a² + b² and q = 1 + k1 r² + k2 r⁴:
///     x = fx (a q + 2 p1 a b + p2 (r² + 2 a²)) + cx
///     y = fy (b q + 2 p2 a b + p1 (r² + 2 b²)) + cy
struct Camera {
    int width = 480;   ///< px
    int height = 768;  ///< px
    double fx = 1140;  ///< px
    double fy = 1140;
    double cx = 242.3;
    double cy = 380.6;
    double k1 = -0.08;
    double k2 = 0.03;
    double p1 = 0;
    double p2 = 0;

    /// The pixel that sees `point` (mm, Z above 0).
    Eigen::Vector2d project(const Eigen::Vector3d& point) const;

    /// The viewing ray of a pixel, scaled to Z = 1: the inverse of project().
    Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

}  // namespace facescan::sim
