#include "sim/artefacts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/ray_caster.h"
#include "sim/truth_maps.h"

namespace facescan::sim {
namespace {

TruthMaps mapsOf(const Scene& scene, const Device& device) {
    const RayCaster caster(scene);
    return castTruthMaps(caster, scene, device, 256, Pose{}, 0, 2);
}

TEST(Artefacts, PlaneHasTheDepthOfItsEquation) {
    const PlaneParameters parameters{.distance_mm = 380, .tilt_x_deg = 12, .tilt_y_deg = -7};
    const Device device = resized(standardDevice(), 60, 96);
    const TruthMaps maps = mapsOf(makePlane(parameters), device);
    const Eigen::Vector3d n = planeNormal(parameters);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 60; ++x) {
            const Eigen::Vector3d ray = device.camera.ray({double(x), double(y)});
            const double z = 380 * n.z() / n.dot(ray);
            EXPECT_NEAR(maps.z[std::size_t(y) * 60 + x], z, 1e-4);
            EXPECT_NEAR(maps.cos_cam[std::size_t(y) * 60 + x], -n.dot(ray.normalized()), 1e-6);
        }
    }
}

TEST(Artefacts, PositiveTiltTakesThePlanesTopAway) {
    const Device device = resized(standardDevice(), 60, 96);
    const TruthMaps maps = mapsOf(makePlane({.tilt_x_deg = 20}), device);
    EXPECT_GT(maps.z[30], 400);
    EXPECT_LT(maps.z[95 * 60 + 30], 400);
}

TEST(Artefacts, SphereHasTheDepthOfItsEquation) {
    const SphereParameters parameters{.centre = {5, -10, 440}, .radius_mm = 50, .edge_mm = 0.5};
    const Device device = resized(standardDevice(), 120, 192);
    const TruthMaps maps = mapsOf(makeSphere(parameters), device);
    // A chord of length e lies up to e² / 8 r inside; the cube's grid has diagonals of 0.8 mm. The
    // ray meets the surface at an angle, so the bound holds along the normal.
    const double sagitta = 0.8 * 0.8 / (8 * 50);
    int seen = 0;
    for (int y = 0; y < 192; ++y) {
        for (int x = 0; x < 120; ++x) {
            const Eigen::Vector3d ray = device.camera.ray({double(x), double(y)});
            const double b = ray.dot(parameters.centre), a = ray.squaredNorm();
            const double root = b * b - a * (parameters.centre.squaredNorm() - 50 * 50);
            const float z = maps.z[std::size_t(y) * 120 + x];
            if (root < 0) {
                EXPECT_TRUE(std::isnan(z));
            } else if (!std::isnan(z)) {
                ++seen;
                EXPECT_NEAR((z * ray - parameters.centre).norm(), 50, sagitta);
                EXPECT_LT(std::abs(z - (b - std::sqrt(root)) / a), 1.0);
            }
        }
    }
    const double apparent_radius = 285 * 50 / std::sqrt(440 * 440 - 50 * 50.0);
    EXPECT_NEAR(seen, 3.14159 * apparent_radius * apparent_radius, 0.02 * seen);
}

TEST(Artefacts, StepsHaveTheDepthOfTheirTreads) {
    const StepsParameters parameters;
    const Device device = resized(standardDevice(), 60, 768);
    const TruthMaps maps = mapsOf(makeSteps(parameters), device);
    for (int i = 0; i <= int(parameters.steps_mm.size()); ++i) {
        const double z = treadDepth(parameters, i);
        const double y_mm = treadTop(parameters, i) + parameters.tread_mm / 2;
        const Eigen::Vector2d pixel = device.camera.project({0, y_mm, z});
        const auto index = std::size_t(std::lround(pixel.y())) * 60 + std::lround(pixel.x());
        EXPECT_NEAR(maps.z[index], z, 1e-4) << "tread " << i;
    }
    EXPECT_NEAR(treadDepth(parameters, 6), 400 - 38.5, 1e-12);
}

}  // namespace
}  // namespace facescan::sim
