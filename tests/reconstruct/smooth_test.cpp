#include "reconstruct/smooth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reconstruct/grids.h"

namespace facescan {
namespace {

using namespace test;

constexpr int kCodes = 40;
constexpr int kColumns = 90;
constexpr float kContrast = 40;  // grey levels per px

double quadratic(int code, int column) {
    const double c = code - 20;
    const double x = column - 45;
    return 100 + 4 * c + 0.2 * x + 0.004 * c * c - 0.003 * c * x + 0.001 * x * x;
}

/// A surface with Gaussian noise, px.
VertexGrid noisy(const GridField& surface, double noise_px, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise_px);
    return makeGrid(
        kCodes, kColumns,
        [&](int code, int column) { return surface(code, column) + normal(random); }, kContrast);
}

int smooth(double noise_px, VertexGrid& grid, const Options& options = {}) {
    SmoothScratch scratch;
    return smoothEdges(options, {float(noise_px * kContrast)}, scratch, grid);
}

/// Root mean square distance from a surface, cells near the border left out.
double distanceFrom(const GridField& surface, const VertexGrid& grid, int margin = 8) {
    double squares = 0;
    int count = 0;
    for (int code = margin; code < grid.codes - margin; ++code) {
        for (int column = margin; column < grid.columns - margin; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::empty) continue;
            squares += std::pow(grid.y[i] - surface(code, column), 2);
            ++count;
        }
    }
    EXPECT_GT(count, 500);
    return std::sqrt(squares / count);
}

TEST(Noise, IsMeasuredInGreyLevels) {
    std::vector<float> scratch;
    for (const double noise_px : {0.02, 0.1, 0.3}) {
        const EdgeNoise noise = estimateNoise(noisy(quadratic, noise_px, 1), scratch);
        EXPECT_NEAR(noise.grey_levels, noise_px * kContrast, 0.05 * noise_px * kContrast);
        EXPECT_FLOAT_EQ(noise.pixels(10), noise.grey_levels / 10);
    }
}

TEST(Noise, OfASmoothSurfaceIsZero) {
    std::vector<float> scratch;
    const VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    EXPECT_LT(estimateNoise(grid, scratch).grey_levels, 1e-3);
}

TEST(Noise, IsNotRaisedByStepsAndHoles) {
    VertexGrid grid = noisy(
        [](int code, int column) { return quadratic(code, column) + (code > 25 ? 7 : 0); }, 0.1, 2);
    cutHole(8, 20, 6, 30, grid);
    std::vector<float> scratch;
    EXPECT_NEAR(estimateNoise(grid, scratch).grey_levels, 4.0, 0.4);
}

TEST(Noise, OfAnEmptyGridIsZero) {
    std::vector<float> scratch;
    const VertexGrid grid = makeGrid(kCodes, kColumns, [](int, int) { return std::nan(""); });
    EXPECT_EQ(estimateNoise(grid, scratch).grey_levels, 0);
    EXPECT_EQ(EdgeNoise{5}.pixels(0), 0) << "no contrast, no noise known";
}

TEST(Smooth, ReproducesAQuadraticSurface) {
    for (const double noise_px : {0.0, 0.1, 0.3}) {
        VertexGrid grid = makeGrid(kCodes, kColumns, quadratic, kContrast);
        EXPECT_EQ(smooth(noise_px, grid), 0);
        EXPECT_LT(distanceFrom(quadratic, grid), 1e-3) << "inside";
        EXPECT_LT(distanceFrom(quadratic, grid, 1), 2e-3) << "up to the border";
    }
}

TEST(Smooth, TakesAwayMostOfTheNoise) {
    // A quadratic fitted to k × 3 neighbours leaves the root of its middle weight.
    for (const double noise_px : {0.05, 0.12, 0.3}) {
        VertexGrid grid = noisy(quadratic, noise_px, 3);
        smooth(noise_px, grid);
        EXPECT_LT(distanceFrom(quadratic, grid), 0.6 * noise_px) << noise_px << " px";
    }
}

TEST(Smooth, TakesAwayMoreWhereThereIsMoreNoise) {
    const auto left = [](double noise_px) {
        VertexGrid grid = noisy(quadratic, noise_px, 4);
        smooth(noise_px, grid);
        return distanceFrom(quadratic, grid) / noise_px;
    };
    EXPECT_LT(left(0.4), 0.6 * left(0.04));
}

TEST(Smooth, DoesNotShiftTheSurface) {
    VertexGrid grid = noisy(quadratic, 0.2, 5);
    smooth(0.2, grid);
    double sum = 0;
    int count = 0;
    for (int code = 8; code < kCodes - 8; ++code) {
        for (int column = 8; column < kColumns - 8; ++column) {
            sum += grid.y[grid.index(code, column)] - quadratic(code, column);
            ++count;
        }
    }
    // The mean of so many cells is known to 0.2 px over the root of their number.
    EXPECT_LT(std::fabs(sum / count), 4 * 0.2 / std::sqrt(double(count)));
}

/// A quadratic surface with a step after column 39.
GridField stepped(double height_px) {
    return [=](int code, int column) {
        return quadratic(code, column) + (column >= 40 ? height_px : 0);
    };
}

TEST(Smooth, KeepsAStepSharpWhoseEndsAreKnown) {
    const GridField surface = stepped(3);
    VertexGrid grid = makeGrid(kCodes, kColumns, surface, kContrast);
    for (int code = 1; code < kCodes; ++code) {
        for (const int column : {38, 39, 40, 41}) {
            grid.cell[grid.index(code, column)] = Cell::end;
        }
    }
    smooth(0.03, grid);
    EXPECT_LT(distanceFrom(surface, grid), 5e-3);
    for (int code = 8; code < kCodes - 8; ++code) {
        for (const int column : {36, 37, 42, 43}) {
            ASSERT_EQ(grid.cell[grid.index(code, column)], Cell::measured);
        }
    }
}

TEST(Smooth, DoesNotSmearALowStep) {
    for (const double height : {0.5, 1.0, 1.5}) {
        const GridField surface = stepped(height);
        VertexGrid grid = makeGrid(kCodes, kColumns, surface, kContrast);
        smooth(0.03, grid);
        for (int code = 8; code < kCodes - 8; ++code) {
            for (int column = 30; column < 50; ++column) {
                const std::size_t i = grid.index(code, column);
                const bool beside = column >= 38 && column <= 41;
                ASSERT_TRUE(beside || grid.cell[i] == Cell::measured) << "column " << column;
                if (grid.cell[i] == Cell::empty) continue;
                EXPECT_NEAR(grid.y[i], surface(code, column), beside ? 0.2 : 0.06)
                    << "column " << column << ", step " << height;
            }
        }
    }
}

TEST(Smooth, KeepsAStepBetweenStripesSharp) {
    const GridField surface = [](int code, int column) {
        return quadratic(code, column) + (code >= 20 ? 4 : 0);
    };
    VertexGrid grid = makeGrid(kCodes, kColumns, surface, kContrast);
    EXPECT_EQ(smooth(0.03, grid), 0);
    EXPECT_LT(distanceFrom(surface, grid), 0.01);
}

TEST(Smooth, EmptiesAnOutlierAndSparesItsNeighbours) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic, kContrast);
    const std::size_t outlier = grid.index(20, 45);
    grid.y[outlier] += 1.5f;
    EXPECT_EQ(smooth(0.03, grid), 1);
    EXPECT_EQ(grid.cell[outlier], Cell::empty);
    EXPECT_LT(distanceFrom(quadratic, grid), 5e-3);
}

TEST(Smooth, ToleratesWhatTheNoiseExplains) {
    VertexGrid grid = noisy(quadratic, 0.1, 6);
    Options options;
    options.outlier_sigmas = 6;
    EXPECT_EQ(smooth(0.1, grid, options), 0);
}

TEST(Smooth, FollowsTheSurfaceBesideAHole) {
    VertexGrid grid = noisy(quadratic, 0.05, 7);
    cutHole(15, 30, 8, 20, grid);
    smooth(0.05, grid);
    EXPECT_LT(distanceFrom(quadratic, grid), 0.04);
    EXPECT_EQ(grid.cell[grid.index(18, 40)], Cell::empty) << "smoothing fills nothing";
}

}  // namespace
}  // namespace facescan
