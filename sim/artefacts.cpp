#include "sim/artefacts.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace facescan::sim {

namespace {

/// Appends a rectangle with vertices of its own, so that edges between rectangles stay sharp.
/// The corners run counter-clockwise seen from the side that reflects.
void addQuad(Surface& surface, const std::array<Eigen::Vector3d, 4>& corners) {
    const auto first = std::uint32_t(surface.positions.size());
    for (const Eigen::Vector3d& corner : corners) surface.positions.push_back(corner.cast<float>());
    surface.triangles.push_back({first, first + 1, first + 2});
    surface.triangles.push_back({first, first + 2, first + 3});
}

void finish(Surface& surface, const Material& material) {
    surface.materials.assign(surface.positions.size(), material);
    computeNormals(surface);
}

Eigen::Matrix3d tilt(const PlaneParameters& parameters) {
    constexpr double kDegree = std::numbers::pi / 180;
    return (Eigen::AngleAxisd(parameters.tilt_y_deg * kDegree, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(-parameters.tilt_x_deg * kDegree, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}

}  // namespace

Scene makePlane(const PlaneParameters& parameters) {
    const double half = parameters.size_mm / 2;
    const Eigen::Matrix3d rotation = tilt(parameters);
    const auto corner = [&](double x, double y) -> Eigen::Vector3d {
        return rotation * Eigen::Vector3d(x, y, 0) + Eigen::Vector3d(0, 0, parameters.distance_mm);
    };
    Scene scene{.kind = "plane"};
    addQuad(scene.surface,
            {corner(-half, -half), corner(-half, half), corner(half, half), corner(half, -half)});
    finish(scene.surface, parameters.material);
    return scene;
}

Eigen::Vector3d planeNormal(const PlaneParameters& parameters) {
    return tilt(parameters) * Eigen::Vector3d(0, 0, -1);
}

Scene makeSphere(const SphereParameters& parameters) {
    Scene scene{.kind = "sphere"};
    scene.sphere = Sphere{parameters.centre, parameters.radius_mm};
    Surface& surface = scene.surface;
    // A cube's face towards the camera and the halves of the four beside it, blown up: a grid of
    // nearly even triangles over the visible hemisphere.
    const int n = std::max(
        4, int(std::ceil(parameters.radius_mm * std::numbers::pi / 2 / parameters.edge_mm)));
    const auto onSphere = [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
        return parameters.centre + parameters.radius_mm * direction.normalized();
    };
    const auto addPatch = [&](const Eigen::Matrix3d& frame, int rows) {
        const auto first = std::uint32_t(surface.positions.size());
        const auto at = [&](int i, int j) { return first + std::uint32_t(j * (n + 1) + i); };
        for (int j = 0; j <= rows; ++j) {
            for (int i = 0; i <= n; ++i) {
                const double u = std::tan((2.0 * i / n - 1) * std::numbers::pi / 4);
                const double v = std::tan((2.0 * j / n - 1) * std::numbers::pi / 4);
                const Eigen::Vector3d p = onSphere(frame * Eigen::Vector3d(u, v, -1));
                surface.positions.push_back(p.cast<float>());
            }
        }
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < n; ++i) {
                surface.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
                surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
            }
        }
    };
    addPatch(Eigen::Matrix3d::Identity(), n);
    for (int side = 0; side < 4; ++side) {
        // The patch's −Z looks sideways; its v = −1 edge joins the front.
        const Eigen::AngleAxisd around(side * std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
        const Eigen::AngleAxisd over(std::numbers::pi / 2, Eigen::Vector3d::UnitX());
        addPatch((around * over).toRotationMatrix(), (n + 1) / 2);
    }
    surface.materials.assign(surface.positions.size(), parameters.material);
    surface.normals.reserve(surface.positions.size());
    for (const Eigen::Vector3f& p : surface.positions) {
        surface.normals.push_back((p - parameters.centre.cast<float>()).normalized());
    }
    return scene;
}

double treadDepth(const StepsParameters& parameters, int index) {
    double depth = parameters.distance_mm;
    for (int i = 0; i < index; ++i) depth -= parameters.steps_mm[i];
    return depth;
}

double treadTop(const StepsParameters& parameters, int index) {
    const int treads = int(parameters.steps_mm.size()) + 1;
    return parameters.tread_mm * (index - treads / 2.0);
}

Scene makeSteps(const StepsParameters& parameters) {
    Scene scene{.kind = "step"};
    const double x = parameters.width_mm / 2;
    const int treads = int(parameters.steps_mm.size()) + 1;
    for (int i = 0; i < treads; ++i) {
        const double top = treadTop(parameters, i), bottom = treadTop(parameters, i + 1);
        const double z = treadDepth(parameters, i);
        addQuad(scene.surface, {Eigen::Vector3d(-x, top, z), Eigen::Vector3d(-x, bottom, z),
                                Eigen::Vector3d(x, bottom, z), Eigen::Vector3d(x, top, z)});
        if (i + 1 == treads) break;
        const double nearer = treadDepth(parameters, i + 1);
        addQuad(scene.surface, {Eigen::Vector3d(-x, bottom, z), Eigen::Vector3d(-x, bottom, nearer),
                                Eigen::Vector3d(x, bottom, nearer), Eigen::Vector3d(x, bottom, z)});
    }
    finish(scene.surface, parameters.material);
    return scene;
}

}  // namespace facescan::sim
