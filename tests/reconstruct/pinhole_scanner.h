#pragma once

#include <Eigen/Core>
#include <functional>

#include "reconstruct/scan.h"
#include "reconstruct/striped_scene.h"

namespace facescan::test {

/// An ideal scanner: a pinhole camera at the origin and, 120 mm above it, a pinhole projector
/// aimed at the point 400 mm in front of the camera. Small images of the proportions of the real
/// device: 0.4 mm a pixel and 3.6 pixels a stripe at 400 mm.
struct PinholeScanner {
    CodeAxis axis = CodeAxis::y;  ///< x: camera and projector are turned, the baseline runs along x
    bool rising = true;           ///< whether the projector is mounted so that the code rises
    int bits = 8;
    int width = 160;
    int height = 200;
    double focal_px = 1000;
    double stripes_per_radian = 278;

    /// Direction of a pixel's ray, its Z component 1.
    Eigen::Vector3d ray(double x, double y) const;
    /// Where the camera sees a point, px.
    Eigen::Vector2d project(const Eigen::Vector3d& point) const;
    /// The projector coordinate of a point, stripes.
    double codeOf(const Eigen::Vector3d& point) const;

    /// A description whose polynomial of degree 5 is fitted to this geometry between two depths.
    ScanDescription describe(FrameOrder order, double min_mm, double max_mm) const;
};

/// The distance along a ray, in mm of Z, at which it meets a surface; not a number where it does
/// not.
using Surface = std::function<double(const Eigen::Vector3d& ray)>;

/// The plane z = depth + slope_x · x + slope_y · y.
Surface planeSurface(double depth, double slope_x, double slope_y);
/// The side of a sphere that faces the camera.
Surface sphereSurface(const Eigen::Vector3d& centre, double radius);

/// The scene that the scanner sees of a surface.
StripedScene sceneOf(const PinholeScanner& scanner, const Surface& surface);

}  // namespace facescan::test
