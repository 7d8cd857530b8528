#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/scene.h"

/// Bodies whose depth is known in closed form, before the camera at `distance_mm` on its axis.
namespace facescan::sim {

struct PlaneParameters {
    double distance_mm = 400;  ///< where the camera's axis meets the plane
    double tilt_x_deg = 0;     ///< turned about the image's x axis: positive takes the top away
    double tilt_y_deg = 0;     ///< turned about the image's y axis
    double size_mm = 600;      ///< edge of the square
    Material material = {0.7f, 0.0f};
};

Scene makePlane(const PlaneParameters& parameters = {});

/// The plane's unit normal, towards the camera.
Eigen::Vector3d planeNormal(const PlaneParameters& parameters);

struct SphereParameters {
    Eigen::Vector3d centre = {0, 0, 450};
    double radius_mm = 60;
    double edge_mm = 0.5;  ///< edge of its triangles; they lie edge²/(8 · radius) inside, at most
    Material material = {0.7f, 0.0f};
};

Scene makeSphere(const SphereParameters& parameters = {});

struct StepsParameters {
    double distance_mm = 400;  ///< depth of the tread at which the stairs begin
    double width_mm = 200;     ///< along x
    double tread_mm = 25;      ///< height of a tread in the image, along y
    std::vector<double> steps_mm = {0.5, 1, 2, 5, 10, 20};  ///< each tread is nearer by this
    Material material = {0.7f, 0.0f};
};

/// Stairs: treads that face the camera, stacked along y from top to bottom, the nearest lowest,
/// joined by risers along z.
Scene makeSteps(const StepsParameters& parameters = {});

/// The depth of tread `index`, 0 … steps_mm.size().
double treadDepth(const StepsParameters& parameters, int index);

/// The upper edge of tread `index`, along y.
double treadTop(const StepsParameters& parameters, int index);

}  // namespace facescan::sim
