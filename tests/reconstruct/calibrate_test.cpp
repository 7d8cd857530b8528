#include "reconstruct/calibrate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reconstruct/grids.h"

namespace facescan {
namespace {

/// A calibration like a device's: about 400 mm away, each further term smaller than the last.
ScanDescription someScan(int degree, CodeAxis axis, unsigned seed) {
    ScanDescription scan;
    scan.image = {7, 14, 480, 754};
    scan.pattern = {.bits = 8, .axis = axis};
    Calibration& calibration = scan.calibration;
    calibration.degree = degree;
    calibration.x = {239.5, 240};
    calibration.y = {390.5, -377};
    calibration.code = {128, 128};
    calibration.range_min_mm = 300;
    calibration.range_max_mm = 520;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::vector<double>& output : calibration.coefficients) {
        for (int i = 0; i <= degree; ++i) {
            for (int j = 0; j <= degree - i; ++j) {
                for (int k = 0; k <= degree - i - j; ++k) {
                    output.push_back(100 * uniform(random) * std::pow(0.6, i + j + k));
                }
            }
        }
    }
    calibration.coefficients[2].front() += 400;
    return scan;
}

/// The formula of the bundle format, term by term.
double formula(const Calibration& calibration, int output, double x, double y, double code) {
    const double u = (x - calibration.x.offset) / calibration.x.scale;
    const double v = (y - calibration.y.offset) / calibration.y.scale;
    const double w = (code - calibration.code.offset) / calibration.code.scale;
    const int d = calibration.degree;
    double sum = 0;
    std::size_t n = 0;
    for (int i = 0; i <= d; ++i) {
        for (int j = 0; j <= d - i; ++j) {
            for (int k = 0; k <= d - i - j; ++k) {
                sum += calibration.coefficients[output][n++] * std::pow(u, i) * std::pow(v, j) *
                       std::pow(w, k);
            }
        }
    }
    EXPECT_EQ(n, calibration.coefficients[output].size());
    return sum;
}

/// The formula at a place of the stripe image, which is cropped and may lie on its side.
double formulaInStripeImage(const ScanDescription& scan, int output, int column, double y,
                            int code) {
    const bool turned = scan.pattern.axis == CodeAxis::x;
    const double image_x = turned ? y : column;
    const double image_y = turned ? column : y;
    return formula(scan.calibration, output, image_x + scan.image.x, image_y + scan.image.y, code);
}

class CalibrationOfDegree : public testing::TestWithParam<int> {};

TEST_P(CalibrationOfDegree, IsThePolynomialOfTheFormat) {
    constexpr double kTolerance = 2e-4;  // mm: single precision at some hundred millimetres
    for (const CodeAxis axis : {CodeAxis::x, CodeAxis::y}) {
        const ScanDescription scan = someScan(GetParam(), axis, 11 + GetParam());
        GridCalibration calibration;
        calibration.prepare(scan, 480, false);
        for (const int code : {1, 40, 128, 255}) {
            for (const int column : {0, 77, 300, 479}) {
                for (const double y : {0.0, 12.25, 200.5, 460.75}) {
                    const Point point = calibration.at(code, column, float(y));
                    const auto expected = [&](int output, double at) {
                        return formulaInStripeImage(scan, output, column, at, code);
                    };
                    ASSERT_NEAR(point.x, expected(0, y), kTolerance);
                    ASSERT_NEAR(point.y, expected(1, y), kTolerance);
                    ASSERT_NEAR(point.z, expected(2, y), kTolerance);
                    const auto slope = [&](int output) {
                        return (expected(output, y + 0.01) - expected(output, y - 0.01)) / 0.02;
                    };
                    const Point change = calibration.slopeAt(code, column, float(y));
                    ASSERT_NEAR(change.x, slope(0), kTolerance);
                    ASSERT_NEAR(change.y, slope(1), kTolerance);
                    ASSERT_NEAR(change.z, slope(2), kTolerance);
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Degrees, CalibrationOfDegree, testing::Range(1, 6));

class CalibratedGrid : public testing::Test {
protected:
    CalibratedGrid() {
        calibration_.prepare(scan_, grid_.columns, false);
        grid_.cell[grid_.index(3, 4)] = Cell::filled;
        grid_.cell[grid_.index(5, 6)] = Cell::end;
        grid_.cell[grid_.index(7, 8)] = Cell::empty;
    }

    void expectPoint(int code, int column) const {
        const std::size_t i = grid_.index(code, column);
        const auto expected = [&](int output) {
            return formulaInStripeImage(scan_, output, column, grid_.y[i], code);
        };
        EXPECT_NEAR(points_[i].x, expected(0), 2e-4);
        EXPECT_NEAR(points_[i].y, expected(1), 2e-4);
        EXPECT_NEAR(points_[i].z, expected(2), 2e-4);
    }

    void setAll(const Point& point) {
        points_.resize(grid_.size());
        for (std::size_t i = 0; i < grid_.size(); ++i) points_.set(i, point);
    }

    ScanDescription scan_ = someScan(5, CodeAxis::y, 1);
    VertexGrid grid_ = test::makeGrid(16, 20, [](int code, int x) { return 9.0 * code + x; });
    GridCalibration calibration_;
    PointPlanes points_;
};

TEST_F(CalibratedGrid, HasAPointForEachCellThatIsNotEmpty) {
    calibrateCells(calibration_, grid_, points_);
    ASSERT_GE(points_.size(), grid_.size());
    for (int code = 1; code < grid_.codes; ++code) {
        for (int column = 0; column < grid_.columns; ++column) {
            if (grid_.cell[grid_.index(code, column)] != Cell::empty) expectPoint(code, column);
        }
    }
}

TEST_F(CalibratedGrid, FollowsTheCalibrationOfTheNextScan) {
    const ScanDescription other = someScan(3, CodeAxis::y, 2);
    calibration_.prepare(other, grid_.columns, false);
    calibrateCells(calibration_, grid_, points_);
    EXPECT_NEAR(points_[grid_.index(5, 6)].z,
                formulaInStripeImage(other, 2, 6, grid_.y[grid_.index(5, 6)], 5), 2e-4);
}

TEST_F(CalibratedGrid, KeepsTheMeasuredPointsWhenHolesAreFilled) {
    setAll({1, 2, 3});
    calibrateFilledCells(calibration_, grid_, points_);
    expectPoint(3, 4);
    for (std::size_t i = 0; i < grid_.size(); ++i) {
        if (grid_.cell[i] == Cell::filled) continue;
        EXPECT_EQ(points_[i].x, 1);
        EXPECT_EQ(points_[i].y, 2);
        EXPECT_EQ(points_[i].z, 3);
    }
}

TEST_F(CalibratedGrid, LosesTheCellsOutsideTheMeasurementRange) {
    setAll({0, 0, 400});
    points_.z[grid_.index(1, 1)] = 299.9f;
    points_.z[grid_.index(2, 2)] = 520.1f;
    points_.z[grid_.index(4, 4)] = 300.0f;
    points_.z[grid_.index(6, 6)] = 520.0f;
    points_.z[grid_.index(7, 8)] = 100.0f;  // empty already
    points_.z[grid_.index(9, 9)] = std::nanf("");
    std::vector<std::uint8_t> scratch;
    EXPECT_EQ(rejectOutOfRange(scan_.calibration, points_, scratch, grid_), 3);
    EXPECT_EQ(grid_.cell[grid_.index(1, 1)], Cell::empty);
    EXPECT_EQ(grid_.cell[grid_.index(2, 2)], Cell::empty);
    EXPECT_EQ(grid_.cell[grid_.index(9, 9)], Cell::empty);
    EXPECT_EQ(grid_.cell[grid_.index(4, 4)], Cell::measured) << "the range includes its ends";
    EXPECT_EQ(grid_.cell[grid_.index(6, 6)], Cell::measured);
    EXPECT_EQ(grid_.cell[grid_.index(3, 4)], Cell::filled);
}

}  // namespace
}  // namespace facescan
