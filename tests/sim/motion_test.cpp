#include "sim/motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace facescan::sim {
namespace {

constexpr double kInterval = 1 / 60.0;

TEST(Motion, StillScannerStaysAtTheOrigin) {
    for (const Pose& pose : posesOf({}, 20, 2, 16, kInterval, 1)) EXPECT_EQ(pose, Pose{});
}

TEST(Motion, WorldIsTheScannerAtTheFirstPatternFrame) {
    Motion motion;
    motion.tremor_mm = {0.3, 0.3, 0.3};
    motion.tremor_deg = {0.1, 0.1, 0.1};
    motion.drift_mm = {1, 2, 3};
    EXPECT_EQ(posesOf(motion, 20, 3, 16, kInterval, 5)[3], Pose{});
}

TEST(Motion, DriftIsSpreadEvenlyOverThePatternFrames) {
    Motion motion;
    motion.drift_mm = {0.3, -1.5, 0.6};
    const std::vector<Pose> poses = posesOf(motion, 18, 1, 16, kInterval, 1);
    for (int frame = 0; frame < 18; ++frame) {
        const Eigen::Vector3d expected = motion.drift_mm * (frame - 1) / 15.0;
        EXPECT_NEAR((poses[frame].translation - expected).norm(), 0, 1e-12);
        EXPECT_TRUE(poses[frame].rotation.isIdentity(1e-12));
    }
}

TEST(Motion, TurnsAboutItsPivot) {
    Motion motion;
    motion.drift_deg = {0, 0, 90};
    motion.pivot_mm = {10, 0, 50};
    const Pose last = posesOf(motion, 2, 0, 2, kInterval, 1)[1];
    EXPECT_NEAR((last * motion.pivot_mm - motion.pivot_mm).norm(), 0, 1e-12);
    EXPECT_NEAR((last * Eigen::Vector3d(11, 0, 50) - Eigen::Vector3d(10, 1, 50)).norm(), 0, 1e-12);
}

TEST(Motion, TremorHasTheGivenAmplitude) {
    Motion motion;
    motion.tremor_mm = {0.2, 0, 0.4};
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    const int seeds = 40, frames = 600;
    for (int seed = 0; seed < seeds; ++seed) {
        const std::vector<Pose> poses = posesOf(motion, frames, 0, 16, kInterval, seed);
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const Pose& pose : poses) mean += pose.translation / frames;
        for (const Pose& pose : poses) {
            squares += (pose.translation - mean).cwiseAbs2() / (frames * seeds);
        }
    }
    EXPECT_NEAR(std::sqrt(squares.x()), 0.2, 0.01);
    EXPECT_EQ(squares.y(), 0);
    EXPECT_NEAR(std::sqrt(squares.z()), 0.4, 0.02);
}

TEST(Motion, TremorFollowsItsSeed) {
    Motion motion;
    motion.tremor_mm = {0.2, 0.2, 0.2};
    EXPECT_EQ(posesOf(motion, 16, 0, 16, kInterval, 9), posesOf(motion, 16, 0, 16, kInterval, 9));
    EXPECT_NE(posesOf(motion, 16, 0, 16, kInterval, 9), posesOf(motion, 16, 0, 16, kInterval, 8));
}

}  // namespace
}  // namespace facescan::sim
