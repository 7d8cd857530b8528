#include "reconstruct/device_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reconstruct/calibrate.h"
#include "reconstruct/pinhole_scanner.h"
#include "reconstruct/recorded_truth.h"

namespace facescan {
namespace {

using namespace test;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The largest distance between a device's points and those that a calibration gives them, over
/// the image and the measurement range, mm.
double worstOf(const ScanDescription& scan, bool recover_device,
               const std::function<Vector3d(double x, double y)>& ray,
               const std::function<double(const Vector3d& point)>& code_of) {
    const bool turned = scan.pattern.axis == CodeAxis::x;
    const int columns = turned ? scan.image.height : scan.image.width;
    const int rows = turned ? scan.image.width : scan.image.height;
    GridCalibration calibration;
    calibration.prepare(scan, columns, recover_device);
    const auto rayAt = [&](int column, double y) {
        return turned ? ray(y + scan.image.x, column + scan.image.y)
                      : ray(column + scan.image.x, y + scan.image.y);
    };
    const Calibration& c = scan.calibration;
    double worst = 0;
    for (int code = 1; code < scan.pattern.stripes(); code += 9) {
        for (int column = 0; column < columns; column += columns / 12) {
            for (int y = 0; y < rows; y += rows / 12) {
                // The depth at which the pixel's ray meets the edge's plane.
                double low = c.range_min_mm;
                double high = c.range_max_mm;
                const Vector3d r = rayAt(column, y);
                const bool below = code_of(low * r) < code;
                if (below == (code_of(high * r) < code)) continue;
                for (int step = 0; step < 50; ++step) {
                    const double middle = 0.5 * (low + high);
                    ((code_of(middle * r) < code) == below ? low : high) = middle;
                }
                const Point p = calibration.at(code, column, float(y));
                worst = std::max(worst, (Vector3d(p.x, p.y, p.z) - low * r).norm());
            }
        }
    }
    EXPECT_GT(worst, 0);
    return worst;
}

TEST(DeviceModel, IsRecoveredFromThePolynomialsOfAnIdealScanner) {
    for (const CodeAxis axis : {CodeAxis::x, CodeAxis::y}) {
        const PinholeScanner scanner{.axis = axis, .width = 480, .height = 640};
        const ScanDescription scan = scanner.describe(FrameOrder::interleaved, 300, 520);
        ASSERT_TRUE(recoverDevice(scan));
        const auto ray = [&](double x, double y) { return scanner.ray(x, y); };
        const auto code = [&](const Vector3d& point) { return scanner.codeOf(point); };
        const double polynomials = worstOf(scan, false, ray, code);
        const double device = worstOf(scan, true, ray, code);
        EXPECT_LT(device, 0.05);
        EXPECT_LT(device, 0.3 * polynomials);
    }
}

/// The projector of the recorded scans, as the ray caster documents it.
double recordedCode(const Vector3d& point, int bits) {
    Eigen::Matrix3d rotation;
    rotation << 0.9999617338381741, -0.003833645407789095, 0.007863461212492474,
        0.005918224913459421, 0.9584062404146112, -0.285346198412042, -0.006442474154138629,
        0.2853818170402909, 0.958392254262082;
    const Vector3d p =
        rotation * point + Vector3d(-1.9363896660544753, 114.14383291714702, 37.130658518852364);
    return (1 << bits) * 0.5 * (p.y() / p.z() / 0.38 + 1);
}

TEST(DeviceModel, IsRecoveredFromThePolynomialsOfARecordedScan) {
    const ScanDescription scan = recordedScan("plane_near").description;
    ASSERT_TRUE(recoverDevice(scan));
    const RecordedCamera camera;
    const auto ray = [&](double x, double y) { return camera.ray(Vector2d(x, y)); };
    const auto code = [](const Vector3d& point) { return recordedCode(point, 8); };
    const double polynomials = worstOf(scan, false, ray, code);
    const double device = worstOf(scan, true, ray, code);
    EXPECT_LT(device, 0.08);
    EXPECT_LT(device, 0.3 * polynomials);
}

TEST(DeviceModel, IsNotForcedUponAnotherKindOfDevice) {
    // Depths that wave by a millimetre over the image: a bent board was taken for a plane.
    ScanDescription scan = PinholeScanner{}.describe(FrameOrder::interleaved, 300, 520);
    std::vector<double>& depth = scan.calibration.coefficients[2];
    depth[polynomialTerms(5) - 1] += 1;  // u^5
    depth[2] += 0.5;                     // w²
    EXPECT_FALSE(recoverDevice(scan));
}

TEST(DeviceModel, IsNotSoughtInPolynomialsWithoutARange) {
    ScanDescription scan = PinholeScanner{}.describe(FrameOrder::interleaved, 300, 520);
    scan.calibration.range_min_mm = 5000;
    scan.calibration.range_max_mm = 5001;
    EXPECT_FALSE(recoverDevice(scan));
    for (std::vector<double>& output : scan.calibration.coefficients) {
        std::fill(output.begin(), output.end(), 0.0);
    }
    EXPECT_FALSE(recoverDevice(scan));
}

}  // namespace
}  // namespace facescan
