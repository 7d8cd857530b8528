#include "sim/device.h"

#include <gtest/gtest.h>

#include "sim/scene.h"

namespace facescan::sim {
namespace {

const Eigen::Vector3d kPoint(30, -50, 420);

TEST(Device, CodeRisesDownTheImageByDefault) {
    const Device device = standardDevice();
    EXPECT_LT(locate(device.projector, {0, -40, 400}).along,
              locate(device.projector, {0, 40, 400}).along);
    EXPECT_NEAR((device.projector.centre() - Eigen::Vector3d(1.5, -120, -3)).norm(), 0, 1e-9);
}

TEST(Device, UpsideDownProjectorShowsTheSamePictureTurnedByHalf) {
    const ProjectorPoint upright = locate(standardDevice().projector, kPoint);
    const ProjectorPoint turned =
        locate(withProjectorUpsideDown(standardDevice()).projector, kPoint);
    EXPECT_NEAR(turned.along, 1 - upright.along, 1e-12);
    EXPECT_NEAR(turned.across, -upright.across, 1e-12);
}

TEST(Device, SidewaysSeesATurnedPointInTheTurnedPixel) {
    Device device = standardDevice();
    device.camera.p1 = 0.004;
    device.camera.p2 = -0.003;
    const Device turned = sideways(device);
    EXPECT_EQ(turned.axis, CodeAxis::x);
    EXPECT_EQ(turned.camera.width, 768);
    EXPECT_EQ(turned.image, (Rect{0, 0, 754, 480}));

    const Eigen::Vector2d pixel = device.camera.project(kPoint);
    const Eigen::Vector3d turned_point = quarterTurn() * kPoint;
    const Eigen::Vector2d turned_pixel = turned.camera.project(turned_point);
    EXPECT_NEAR(turned_pixel.x(), 767 - pixel.y(), 1e-9);
    EXPECT_NEAR(turned_pixel.y(), pixel.x(), 1e-9);
    EXPECT_NEAR(locate(turned.projector, turned_point).along,
                locate(device.projector, kPoint).along, 1e-12);
}

TEST(Device, AnotherSensorSizeSeesTheSameField) {
    const Device device = standardDevice(), larger = resized(device, 960, 1536);
    const Eigen::Vector2d pixel = device.camera.project(kPoint);
    const Eigen::Vector2d scaled = larger.camera.project(kPoint);
    EXPECT_NEAR(scaled.x() + 0.5, 2 * (pixel.x() + 0.5), 1e-9);
    EXPECT_NEAR(scaled.y() + 0.5, 2 * (pixel.y() + 0.5), 1e-9);
    EXPECT_EQ(larger.image, (Rect{0, 28, 960, 1508}));
}

}  // namespace
}  // namespace facescan::sim
