#include "reconstruct/border.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reconstruct/grids.h"
#include "reconstruct/pinhole_scanner.h"

namespace facescan {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr double kNearest = 360;  // mm
constexpr double kFarthest = 440;

/// A plane that fills the image, as decoding finds it: an edge needs a pixel on either side.
struct Seen {
    PinholeScanner scanner;
    double slope;
    ScanDescription scan;
    GridCalibration calibration;
    PixelPlanes planes;
    VertexGrid grid;
    PointPlanes points;

    Seen(bool rising, double slope_y) : slope(slope_y) {
        scanner.rising = rising;
        scanner.width = 40;
        scan = scanner.describe(FrameOrder::interleaved, kNearest, kFarthest);
        calibration.prepare(scan, scanner.width, false);
        planes.width = scanner.width;
        planes.height = scanner.height;
        planes.stripe.resize(std::size_t(planes.width) * planes.height);
        for (int y = 0; y < planes.height; ++y) {
            for (int x = 0; x < planes.width; ++x) {
                const auto stripe = std::uint32_t(std::floor(codeAt(x, y)));
                planes.stripe[planes.index(x, y)] = std::uint16_t(stripe);
            }
        }
        const double last = scanner.height - 1;
        grid = makeGrid(1 << scanner.bits, scanner.width, [&](int code, int column) {
            const bool first_below = codeAt(column, 0) < code;
            if (first_below == (codeAt(column, last) < code)) return std::nan("");
            double low = 0;
            double high = last;
            for (int step = 0; step < 40; ++step) {
                const double middle = 0.5 * (low + high);
                ((codeAt(column, middle) < code) == first_below ? low : high) = middle;
            }
            return low;
        });
        calibrateCells(calibration, grid, points);
    }

    double codeAt(double x, double y) const {
        const Vector3d ray = scanner.ray(x, y);
        return scanner.codeOf(planeSurface(400, 0.1, slope)(ray) * ray);
    }

    double distance(const Point& p) const {
        return (p.z - 400 - 0.1 * p.x - slope * p.y) / std::sqrt(1 + 0.01 + slope * slope);
    }

    int carry() { return carryToBorder(calibration, planes, scanner.rising, grid, points); }

    /// The least and the greatest place of a column.
    std::pair<float, float> reach(int column) const {
        float low = 1e9f;
        float high = -1e9f;
        for (int code = 1; code < grid.codes; ++code) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::empty) continue;
            low = std::fmin(low, grid.y[i]);
            high = std::fmax(high, grid.y[i]);
        }
        return {low, high};
    }
};

TEST(Border, IsReachedByASurfaceThatRunsBeyondIt) {
    for (const bool rising : {true, false}) {
        for (const double slope : {-0.5, 0.0, 0.3}) {
            Seen seen(rising, slope);
            const VertexGrid before = seen.grid;
            EXPECT_GT(seen.carry(), seen.grid.columns);
            for (int column = 0; column < seen.grid.columns; ++column) {
                const auto [low, high] = seen.reach(column);
                ASSERT_LE(low, 0.5f);
                ASSERT_GE(low, -0.5f);
                ASSERT_GE(high, float(seen.planes.height) - 1.5f);
                ASSERT_LE(high, float(seen.planes.height) - 0.5f);
            }
            for (std::size_t i = 0; i < before.size(); ++i) {
                if (before.cell[i] != Cell::empty) {
                    ASSERT_EQ(seen.grid.cell[i], before.cell[i]);
                    ASSERT_EQ(seen.grid.y[i], before.y[i]);
                } else if (seen.grid.cell[i] != Cell::empty) {
                    ASSERT_EQ(seen.grid.cell[i], Cell::filled);
                    ASSERT_NEAR(seen.distance(seen.points[i]), 0, 0.03);
                }
            }
        }
    }
}

TEST(Border, IsNotReachedFromASurfaceThatEndsBeforeIt) {
    Seen seen(true, 0);
    const int middle = 128;
    cutHole(middle + 10, 0, 256 - middle - 10, seen.grid.columns, seen.grid);
    cutHole(1, 0, middle - 10, seen.grid.columns, seen.grid);
    EXPECT_EQ(seen.carry(), 0);
}

TEST(Border, IsNotReachedWhereItsPixelsShowAnotherStripe) {
    Seen seen(true, 0);
    for (int x = 0; x < 15; ++x) {
        for (const int y : {0, seen.planes.height - 1}) {
            seen.planes.stripe[seen.planes.index(x, y)] = 5;
        }
    }
    seen.carry();
    for (int column = 0; column < seen.grid.columns; ++column) {
        const auto [low, high] = seen.reach(column);
        const bool reached = low <= 0.5f && high >= float(seen.planes.height) - 1.5f;
        EXPECT_EQ(reached, column >= 15) << "column " << column;
    }
}

TEST(Border, IsNotReachedFromASingleEdge) {
    Seen seen(true, 0);
    VertexGrid& grid = seen.grid;
    for (int column = 0; column < grid.columns; ++column) {
        for (int code = 2; code + 2 < grid.codes; code += 2) {
            grid.cell[grid.index(code, column)] = Cell::empty;
        }
    }
    EXPECT_EQ(seen.carry(), 0);
}

}  // namespace
}  // namespace facescan
