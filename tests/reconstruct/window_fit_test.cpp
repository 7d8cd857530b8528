#include "reconstruct/window_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "reconstruct/grids.h"

namespace facescan {
namespace {

using namespace test;

double quadratic(int code, int column) {
    const double c = code - 15;
    const double x = column - 20;
    return 60 + 4 * c + 0.2 * x + 0.02 * c * c - 0.01 * c * x + 0.004 * x * x;
}

VertexGrid noisyGrid(double noise_px, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise_px);
    return makeGrid(30, 40, [&](int code, int column) {
        return quadratic(code, column) + (noise_px > 0 ? normal(random) : 0);
    });
}

/// The quadratic fitted to all cells of a window by Eigen, at the middle.
double fitted(const VertexGrid& grid, const Window& window, int code, int column) {
    const int rows = (2 * window.half_codes + 1) * (2 * window.half_columns + 1);
    Eigen::MatrixXd terms(rows, 6);
    Eigen::VectorXd values(rows);
    int n = 0;
    for (int c = -window.half_codes; c <= window.half_codes; ++c) {
        for (int x = -window.half_columns; x <= window.half_columns; ++x, ++n) {
            terms.row(n) << 1, c, x, c * x, x * x, c * c;
            values(n) = grid.y[grid.index(code + c, column + x)];
        }
    }
    return terms.colPivHouseholderQr().solve(values)(0);
}

class WindowFit : public testing::TestWithParam<int> {
protected:
    const Window& window() const { return kWindows[GetParam()]; }
    RobustFit robust(const VertexGrid& grid, float cutoff) const {
        return robust(grid, cutoff, window().half_codes);
    }
    /// At the cell of code 15 in column 20.
    RobustFit robust(const VertexGrid& grid, float cutoff, int half_codes) const {
        FitPlanes planes;
        planes.assign(grid);
        const FitRequest request{.code = 15, .column = 20, .cutoff = cutoff};
        RobustFit fit;
        robustFits(planes, GetParam(), half_codes, {&request, 1}, {&fit, 1});
        return fit;
    }
};

TEST_P(WindowFit, HasTheWeightsOfALeastSquaresFit) {
    const VertexGrid grid = noisyGrid(1.0, 1);
    const FixedFilter& filter = fixedFilter(GetParam());
    double sum = 0;
    for (int c = -window().half_codes; c <= window().half_codes; ++c) {
        for (int x = -window().half_columns; x <= window().half_columns; ++x) {
            const float weight = filter.along[std::abs(x)] + filter.across[std::abs(c)];
            sum += weight * grid.y[grid.index(15 + c, 20 + x)];
        }
    }
    EXPECT_NEAR(sum, fitted(grid, window(), 15, 20), 1e-4);
}

TEST_P(WindowFit, IsUnweightedWhereNothingStandsOut) {
    const VertexGrid grid = noisyGrid(0.1, 2);
    const RobustFit fit = robust(grid, 100);
    EXPECT_TRUE(fit.consistent);
    EXPECT_NEAR(fit.y, fitted(grid, window(), 15, 20), 2e-3);
}

TEST_P(WindowFit, IsBlindToOutliers) {
    VertexGrid grid = noisyGrid(0, 3);
    grid.y[grid.index(15, 22)] += 5;
    grid.y[grid.index(14, 18)] -= 3;
    const RobustFit fit = robust(grid, 0.2f);
    EXPECT_TRUE(fit.consistent);
    EXPECT_NEAR(fit.y, quadratic(15, 20), 5e-3);
}

TEST_P(WindowFit, FindsACellThatItsNeighboursContradict) {
    VertexGrid grid = noisyGrid(0, 4);
    grid.y[grid.index(15, 20)] += 1;
    EXPECT_FALSE(robust(grid, 0.2f).consistent);
}

TEST_P(WindowFit, DoesWithTheCellsThatAreMeasured) {
    VertexGrid grid = noisyGrid(0, 5);
    cutHole(1, 21, 29, 19, grid);  // right of the cell there is nothing
    grid.cell[grid.index(15, 18)] = Cell::end;
    grid.y[grid.index(15, 18)] += 4;
    const RobustFit fit = robust(grid, 0.2f);
    EXPECT_TRUE(fit.consistent);
    EXPECT_NEAR(fit.y, quadratic(15, 20), 5e-3);
}

TEST_P(WindowFit, OfARowTakesNothingFromTheOthers) {
    VertexGrid grid = makeGrid(30, 40, [](int code, int column) {
        return quadratic(code, column) + (code == 15 ? 0 : 50);
    });
    const RobustFit fit = robust(grid, 0.2f, 0);
    EXPECT_TRUE(fit.consistent);
    EXPECT_NEAR(fit.y, quadratic(15, 20), 5e-3);
}

TEST_P(WindowFit, NeedsEnoughNeighbours) {
    VertexGrid grid = makeGrid(30, 40, [](int code, int column) {
        return code == 15 && column >= 19 && column <= 21 ? quadratic(code, column) : std::nan("");
    });
    EXPECT_FALSE(robust(grid, 0.2f).consistent);
}

INSTANTIATE_TEST_SUITE_P(Windows, WindowFit, testing::Range(0, int(kWindows.size())));

TEST(Windows, GrowWithTheNoise) {
    int last = 0;
    for (float noise = 0; noise < 3; noise += 0.01f) {
        EXPECT_GE(windowFor(noise), last);
        last = windowFor(noise);
        EXPECT_LE(noise, kWindows[last].max_noise_px);
    }
    EXPECT_EQ(windowFor(0), 0);
    EXPECT_EQ(last, int(kWindows.size()) - 1);
}

}  // namespace
}  // namespace facescan
