#include "sim/calibration_fit.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace facescan::sim {
namespace {

TEST(CalibrationFit, DegreeFiveFollowsTheDeviceToATenthOfAMillimetre) {
    const CalibrationFit fit = fitCalibration(standardDevice(), 256);
    EXPECT_LT(fit.residual.rms, 0.08);
    EXPECT_LT(fit.residual.max, 0.6);
    EXPECT_EQ(fit.calibration.coefficients[2].size(), 56u);
}

TEST(CalibrationFit, ResidualIsWhatItsPolynomialsLeave) {
    const Device device = standardDevice();
    const CalibrationFit fit = fitCalibration(device, 256);
    for (const double z : {340.0, 400.0, 480.0}) {
        const Eigen::Vector3d point = z * device.camera.ray({200, 420});
        const double code = 256 * locate(device.projector, point).along;
        const Eigen::Vector3d found = evaluate(fit.calibration, 200, 420, code);
        EXPECT_LT((found - point).norm(), fit.residual.max);
    }
}

TEST(CalibrationFit, HigherDegreesLeaveLess) {
    double before = 1e9;
    for (int degree = 1; degree <= 5; ++degree) {
        const double rms = fitCalibration(standardDevice(), 256, degree).residual.rms;
        EXPECT_LT(rms, 0.7 * before) << degree;
        before = rms;
    }
}

TEST(CalibrationFit, MonomialsAreInTheOrderOfTheFormat) {
    Calibration calibration;
    calibration.degree = 2;
    // u^i v^j w^k for i, then j, then k: 1 w w² v vw v² u uw uv u².
    for (int n = 0; n < 3; ++n) calibration.coefficients[n].assign(10, 0);
    calibration.coefficients[0][1] = 1;  // w
    calibration.coefficients[0][4] = 1;  // vw
    calibration.coefficients[1][6] = 1;  // u
    calibration.coefficients[1][8] = 1;  // uv
    calibration.coefficients[2][9] = 1;  // u²
    const Eigen::Vector3d value = evaluate(calibration, 3, 5, 7);
    EXPECT_EQ(value.x(), 7 + 5 * 7);
    EXPECT_EQ(value.y(), 3 + 3 * 5);
    EXPECT_EQ(value.z(), 9);
}

TEST(CalibrationFit, CoversTheStripesThatTheProjectorShows) {
    Device device = standardDevice();
    device.projector.stripes_shown = 200;
    const CalibrationFit fit = fitCalibration(device, 256);
    const Eigen::Vector3d point = 400 * device.camera.ray({240, 380});
    const double code = 200 * locate(device.projector, point).along;
    EXPECT_LT((evaluate(fit.calibration, 240, 380, code) - point).norm(), 0.3);
}

TEST(CalibrationFit, RefusesAProjectorThatLooksAway) {
    Device device = standardDevice();
    device.projector.pose = aim({0, -120, 0}, {0, -120, -400}, {0, 1, 0});
    EXPECT_THROW(fitCalibration(device, 256), std::invalid_argument);
    EXPECT_THROW(fitCalibration(standardDevice(), 256, 6), std::invalid_argument);
}

}  // namespace
}  // namespace facescan::sim
