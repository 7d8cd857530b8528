#include "sim/camera.h"

#include <gtest/gtest.h>

namespace facescan::sim {
namespace {

TEST(Camera, ProjectsByThePinholeEquationWithoutDistortion) {
    Camera camera;
    camera.k1 = camera.k2 = 0;
    const Eigen::Vector2d pixel = camera.project({20, -30, 400});
    EXPECT_NEAR(pixel.x(), 1140 * 20.0 / 400 + 242.3, 1e-12);
    EXPECT_NEAR(pixel.y(), 1140 * -30.0 / 400 + 380.6, 1e-12);
}

TEST(Camera, DistortsByBrownsModel) {
    Camera camera;
    camera.p1 = 0.003;
    camera.p2 = -0.002;
    const double a = 0.1, b = -0.2, r2 = 0.05;
    const double q = 1 - 0.08 * r2 + 0.03 * r2 * r2;
    const Eigen::Vector2d pixel = camera.project({40, -80, 400});
    EXPECT_NEAR(pixel.x(), 1140 * (a * q + 2 * 0.003 * a * b - 0.002 * (r2 + 2 * a * a)) + 242.3,
                1e-9);
    EXPECT_NEAR(pixel.y(), 1140 * (b * q - 2 * 0.002 * a * b + 0.003 * (r2 + 2 * b * b)) + 380.6,
                1e-9);
}

TEST(Camera, RaysLeadBackToTheirPixels) {
    Camera camera;
    camera.k1 = -0.2;
    camera.p1 = 0.004;
    camera.p2 = -0.003;
    for (const double x : {-1.0, 0.0, 242.3, 479.0}) {
        for (const double y : {-1.0, 100.5, 767.0}) {
            const Eigen::Vector3d ray = camera.ray({x, y});
            EXPECT_EQ(ray.z(), 1);
            const Eigen::Vector2d back = camera.project(ray);
            EXPECT_NEAR(back.x(), x, 1e-9);
            EXPECT_NEAR(back.y(), y, 1e-9);
        }
    }
}

}  // namespace
}  // namespace facescan::sim
