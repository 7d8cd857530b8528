#include "sim/projector.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace facescan::sim {
namespace {

Projector straightProjector() {
    Projector projector;
    projector.pose = aim({0, -120, 0}, {0, -120, 400}, {0, 1, 0});
    return projector;
}

TEST(Projector, HasItsTargetInTheMiddleOfItsField) {
    Projector projector;
    projector.pose = aim({3, -120, -5}, {1, 2, 400}, {0, 1, 0}, 7);
    const ProjectorPoint at = locate(projector, {1, 2, 400});
    EXPECT_NEAR(at.across, 0, 1e-12);
    EXPECT_NEAR(at.along, 0.5, 1e-12);
    EXPECT_NEAR(at.depth, std::sqrt(4 + 122 * 122 + 405 * 405), 1e-9);
    EXPECT_NEAR((projector.centre() - Eigen::Vector3d(3, -120, -5)).norm(), 0, 1e-9);
}

TEST(Projector, PoseIsARotation) {
    const Eigen::Matrix3d r = aim({3, -120, -5}, {1, 2, 400}, {0, 1, 0}, 7).rotation;
    EXPECT_NEAR((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(r.determinant(), 1, 1e-12);
}

TEST(Projector, CodeIsTheTangentAlongItsField) {
    const ProjectorPoint at = locate(straightProjector(), {50, -100, 250});
    EXPECT_NEAR(at.along, (20.0 / 250 / 0.38 + 1) / 2, 1e-12);
    EXPECT_NEAR(at.across, 50.0 / 250 / 0.45, 1e-12);
}

TEST(Projector, CodeFallsWhenMountedUpsideDown) {
    Projector upside_down = straightProjector();
    upside_down.pose = aim({0, -120, 0}, {0, -120, 400}, {0, -1, 0});
    const Eigen::Vector3d point(50, -100, 250);
    EXPECT_NEAR(locate(upside_down, point).along, 1 - locate(straightProjector(), point).along,
                1e-12);
}

TEST(Projector, ShinesOnlyAheadAndInItsField) {
    const Projector projector = straightProjector();
    EXPECT_TRUE(locate(projector, {0, -120, 400}).inField());
    EXPECT_TRUE(locate(projector, {0, -120 + 0.379 * 400, 400}).inField());
    EXPECT_FALSE(locate(projector, {0, -120 + 0.381 * 400, 400}).inField());
    EXPECT_FALSE(locate(projector, {0.451 * 400, -120, 400}).inField());
    EXPECT_FALSE(locate(projector, {0, -120, -400}).inField());
}

TEST(Projector, BlursMoreOutOfFocus) {
    Projector projector = straightProjector();
    projector.blur = 0.3;
    projector.defocus = 2;
    projector.focus_mm = 400;
    EXPECT_DOUBLE_EQ(blurAt(projector, 400), 0.3);
    EXPECT_DOUBLE_EQ(blurAt(projector, 480), std::hypot(0.3, 0.4));
    EXPECT_DOUBLE_EQ(blurAt(projector, 320), std::hypot(0.3, 0.4));
}

TEST(Projector, ShowsNoMoreStripesThanThePatternHas) {
    Projector projector;
    EXPECT_EQ(stripesShown(projector, 256), 256);
    projector.stripes_shown = 200;
    EXPECT_EQ(stripesShown(projector, 256), 200);
    EXPECT_EQ(stripesShown(projector, 128), 128);
}

}  // namespace
}  // namespace facescan::sim
