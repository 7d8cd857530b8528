#include <gtest/gtest.h>

#include <cmath>

#include "sim/artefacts.h"
#include "sim/small_scan.h"

namespace facescan::sim {
namespace {

/// A plane at 420 mm, and before it a square of 30 mm at 380 mm.
Scene planeWithOccluder() {
    Scene scene = makePlane({.distance_mm = 420});
    const Surface square = makePlane({.distance_mm = 380, .size_mm = 30}).surface;
    Surface& surface = scene.surface;
    const auto first = std::uint32_t(surface.positions.size());
    surface.positions.insert(surface.positions.end(), square.positions.begin(),
                             square.positions.end());
    surface.normals.insert(surface.normals.end(), square.normals.begin(), square.normals.end());
    surface.materials.insert(surface.materials.end(), square.materials.begin(),
                             square.materials.end());
    for (Triangle t : square.triangles) {
        for (std::uint32_t& vertex : t) vertex += first;
        surface.triangles.push_back(t);
    }
    return scene;
}

class Shadow : public testing::Test {
protected:
    /// The pixel that sees the plane where the square's point (x, y) shades it: on the line from
    /// the projector through that point.
    std::size_t pixelInShadowOf(double x, double y) const {
        const Eigen::Vector3d light = device.projector.centre(), edge(x, y, 380);
        const double t = (420 - light.z()) / (380 - light.z());
        return pixelOf(light + t * (edge - light));
    }
    std::size_t pixelOf(const Eigen::Vector3d& point) const {
        const Eigen::Vector2d pixel = device.camera.project(point);
        return pixelIndex(device, int(std::lround(pixel.x())), int(std::lround(pixel.y())));
    }

    const Device device = smallQuietDevice();
    const SimulatedScan scan =
        simulate(planeWithOccluder(), device, {.bits = 4, .samples_per_side = 2});
    const TruthMaps& maps = scan.truth.maps[0];
};

TEST_F(Shadow, FallsWhereTheProjectorIsOccluded) {
    // Below the square, whose lower edge hides less from the camera than from the projector.
    EXPECT_EQ(maps.lit[pixelInShadowOf(0, 13)], 0);
    EXPECT_EQ(maps.hit[pixelInShadowOf(0, 13)], 16);
    EXPECT_EQ(maps.lit[pixelInShadowOf(-12, 13)], 0);
    EXPECT_EQ(maps.lit[pixelInShadowOf(12, 13)], 0);
}

TEST_F(Shadow, EndsWhereTheOccludersEdgeDoes) {
    EXPECT_EQ(maps.lit[pixelInShadowOf(0, 17)], 16);
    EXPECT_EQ(maps.lit[pixelInShadowOf(18, 10)], 16);
    EXPECT_EQ(maps.lit[pixelInShadowOf(-18, 10)], 16);
}

TEST_F(Shadow, OccluderItselfIsLit) {
    EXPECT_EQ(maps.lit[pixelOf({0, 0, 380})], 16);
    EXPECT_NEAR(maps.z[pixelOf({0, 0, 380})], 380, 1e-4);
}

TEST_F(Shadow, LeavesAmbientLightAndNoContrast) {
    const std::size_t pixel = pixelInShadowOf(0, 13);
    EXPECT_EQ(scan.truth.contrast[pixel], 0);
    const double ambient = expectedGrey(device.sensor, device.ambient * 0.7);
    for (int frame = 0; frame < 8; ++frame) {
        EXPECT_NEAR(pixelAt(scan, frame, int(pixel % 120), int(pixel / 120)), ambient, 0.6);
    }
}

TEST_F(Shadow, SurfaceTurnedAwayFromTheProjectorIsDark) {
    const SimulatedScan turned = simulate(makePlane({.tilt_x_deg = -80, .size_mm = 150}), device,
                                          {.bits = 4, .samples_per_side = 1});
    const std::size_t middle = pixelOf({0, 0, 400});
    EXPECT_LT(turned.truth.maps[0].cos_proj[middle], 0);
    EXPECT_EQ(turned.truth.maps[0].hit[middle], 16);
    EXPECT_EQ(turned.truth.maps[0].lit[middle], 0);
}

}  // namespace
}  // namespace facescan::sim
