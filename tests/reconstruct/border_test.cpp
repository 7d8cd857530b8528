#include "reconstruct/border.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reconstruct/grids.h"
#include "reconstruct/pinhole_scanner.h"
#include "reconstruct/tessellate.h"

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
    std::array<ImageMotion, kMaxBits> motions{};

    Seen(bool rising, double slope_y) : slope(slope_y) {
        scanner.rising = rising;
        scanner.width = 40;
        scan = scanner.describe(FrameOrder::interleaved, kNearest, kFarthest);
        calibration.prepare(scan, scanner.width, false);
        planes.width = scanner.width;
        planes.height = scanner.height;
        planes.stripe.resize(std::size_t(planes.width) * planes.height);
        planes.modulation.assign(planes.stripe.size(), 100);
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

    /// The pixels from the row `first` to `last` are not lit.
    void darken(int first, int last) {
        for (int y = first; y <= last; ++y) {
            for (int x = 0; x < planes.width; ++x) planes.modulation[planes.index(x, y)] = 0;
        }
    }

    int carry() {
        BorderScratch scratch;
        const SeenStripes seen{calibration, planes, motions, scanner.bits, scanner.rising};
        return carryToBorder({}, seen, scratch, grid, points);
    }

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
                ASSERT_GE(low, -0.501f);
                ASSERT_GE(high, float(seen.planes.height) - 1.5f);
                ASSERT_LE(high, float(seen.planes.height) - 0.499f);
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
    const int columns = seen.grid.columns;
    const int low = int(seen.grid.y[seen.grid.index(middle - 10, 0)]);
    const int high = int(seen.grid.y[seen.grid.index(middle + 10, 0)]);
    seen.darken(0, low);
    seen.darken(high, seen.planes.height - 1);
    cutHole(middle + 9, 0, 256 - middle - 9, columns, seen.grid);
    cutHole(1, 0, middle - 9, columns, seen.grid);
    seen.carry();
    for (int column = 0; column < columns; ++column) {
        const auto [least, greatest] = seen.reach(column);
        ASSERT_GE(least, float(low));
        ASSERT_LE(greatest, float(high));
    }
}

TEST(Border, LiesWhereTheLightEnds) {
    for (const bool rising : {true, false}) {
        Seen seen(rising, 0.2);
        const int middle = seen.planes.height / 2;
        seen.darken(middle, seen.planes.height - 1);
        VertexGrid& grid = seen.grid;
        for (std::size_t i = 0; i < grid.size(); ++i) {
            if (grid.y[i] > float(middle) - 0.5f) grid.cell[i] = Cell::empty;
        }
        EXPECT_GT(seen.carry(), grid.columns);
        for (int column = 0; column < grid.columns; ++column) {
            const float greatest = seen.reach(column).second;
            ASSERT_GE(greatest, float(middle) - 2.5f);
            ASSERT_LE(greatest, float(middle) - 0.5f);
        }
        for (std::size_t i = 0; i < grid.size(); ++i) {
            if (grid.cell[i] != Cell::filled) continue;
            ASSERT_NEAR(seen.distance(seen.points[i]), 0, 0.03);
        }
    }
}

/// A stripe is seen to be a quarter wider than the last, but its edge was not measured.
TEST(Border, LiesWhereTheNextEdgeShowsOnAStillFace) {
    constexpr int kLast = 128;
    const auto widen = [](Seen& seen) {
        VertexGrid& grid = seen.grid;
        cutHole(kLast + 1, 0, 256 - kLast - 1, grid.columns, grid);
        for (int x = 0; x < grid.columns; ++x) {
            const float y = grid.y[grid.index(kLast, x)];
            const float width = y - grid.y[grid.index(kLast - 1, x)];
            for (int row = int(std::ceil(y)); float(row) < y + 1.25f * width; ++row) {
                seen.planes.stripe[seen.planes.index(x, row)] = kLast;
            }
            for (int row = int(std::ceil(y + 1.25f * width)); row < seen.planes.height; ++row) {
                seen.planes.stripe[seen.planes.index(x, row)] = kLast + 1;
            }
        }
    };
    const auto carriedWidth = [](Seen& seen) {
        seen.carry();
        double widths = 0;
        double stripes = 0;
        for (int column = 0; column < seen.grid.columns; ++column) {
            const auto y = [&](int code) { return seen.grid.y[seen.grid.index(code, column)]; };
            widths += y(kLast + 1) - y(kLast);
            stripes += y(kLast) - y(kLast - 1);
        }
        // As a share of the stripe's width, and half a pixel in the same measure.
        return std::pair(widths / stripes, 0.5 * seen.grid.columns / stripes);
    };
    Seen still(true, 0);
    widen(still);
    const auto [seen_width, half_pixel] = carriedWidth(still);
    EXPECT_NEAR(seen_width, 1.25, 1.25 * half_pixel);
    Seen moved(true, 0);
    widen(moved);
    moved.motions.fill({.column = 0, .y = 1, .turn = 0, .scale = 0});
    EXPECT_NEAR(carriedWidth(moved).first, 1, 0.02);
}

TEST(Border, IsJoinedToTheNextStripeAlone) {
    constexpr int kLast = 128;
    // A surface that reaches before this one, this one itself, and one far away.
    for (const float away : {-20.0f, 0.0f, 60.0f}) {
        Seen seen(true, 0);
        VertexGrid& grid = seen.grid;
        cutHole(kLast + 1, 0, 1, grid.columns, grid);
        for (std::size_t i = grid.index(kLast + 2, 0); i < grid.size(); ++i) grid.y[i] += away;
        seen.carry();
        TessellateScratch scratch;
        Quads quads;
        tessellate({}, grid, seen.points, true, scratch, quads);
        for (int column = 0; column + 1 < grid.columns; ++column) {
            const std::size_t i = grid.index(kLast + 1, column);
            ASSERT_EQ(grid.cell[i], Cell::filled);
            ASSERT_TRUE(quads.first[grid.index(kLast, column)]);
            ASSERT_EQ(quads.first[i] != 0, away == 0) << away;
            ASSERT_EQ(quads.second[i] != 0, away == 0) << away;
        }
    }
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
