#include "reconstruct/fill.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reconstruct/grids.h"

namespace facescan {
namespace {

using namespace test;

constexpr int kCodes = 50;
constexpr int kColumns = 80;

double quadratic(int code, int column) {
    const double c = code - 25;
    const double x = column - 40;
    return 100 + 4 * c + 0.3 * x + 0.006 * c * c - 0.004 * c * x + 0.003 * x * x;
}

FillCounts fill(VertexGrid& grid, const Options& options = {}) {
    FillScratch scratch;
    return fillHoles(options, flatPoints(grid), scratch, grid);
}

void expectCells(const VertexGrid& grid, int code, int column, int codes, int columns, Cell kind) {
    for (int c = code; c < code + codes; ++c) {
        for (int x = column; x < column + columns; ++x) {
            ASSERT_EQ(grid.cell[grid.index(c, x)], kind) << "code " << c << ", column " << x;
        }
    }
}

TEST(Fill, ClosesAHoleOnTheSurfaceAroundIt) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    const VertexGrid whole = grid;
    cutHole(20, 30, 4, 12, grid);
    const FillCounts counts = fill(grid);
    EXPECT_EQ(counts.found, 1);
    EXPECT_EQ(counts.filled, 1);
    expectCells(grid, 20, 30, 4, 12, Cell::filled);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        ASSERT_NEAR(grid.y[i], whole.y[i], grid.cell[i] == Cell::filled ? 0.01 : 0.0);
    }
    EXPECT_EQ(countCells(grid, Cell::filled), 48);
}

TEST(Fill, MeetsTheRimOfASurfaceThatIsNoQuadratic) {
    // A ridge runs through the hole.
    const auto ridge = [](int code, int column) {
        return quadratic(code, column) + 0.15 * std::fabs(column - 35.5);
    };
    VertexGrid grid = makeGrid(kCodes, kColumns, ridge);
    cutHole(20, 30, 4, 12, grid);
    EXPECT_EQ(fill(grid).filled, 1);
    for (int code = 20; code < 24; ++code) {
        EXPECT_NEAR(grid.y[grid.index(code, 30)], ridge(code, 30), 0.06);
        EXPECT_NEAR(grid.y[grid.index(code, 41)], ridge(code, 41), 0.06);
    }
}

TEST(Fill, LeavesHolesOpenThatAreTooLarge) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    cutHole(20, 10, 4, 60, grid);  // 12 mm wide
    const FillCounts counts = fill(grid);
    EXPECT_EQ(counts.found, 1);
    EXPECT_EQ(counts.filled, 0);
    expectCells(grid, 20, 10, 4, 60, Cell::empty);

    Options options;
    options.max_hole_mm = 20;
    EXPECT_EQ(fill(grid, options).filled, 1);
}

TEST(Fill, ClosesHolesOfUpToTenMillimetres) {
    // The loop of edges around the hole is 9.6 mm wide and 1.6 mm high.
    VertexGrid grid = makeGrid(kCodes, kColumns, [](int code, int) { return 4.0 * code; });
    cutHole(20, 10, 1, 47, grid);
    EXPECT_EQ(fill(grid).filled, 1);
}

TEST(Fill, NeverExtendsTheOutline) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    cutHole(20, 0, 4, 6, grid);           // a bay of the left border
    cutHole(kCodes - 3, 40, 3, 6, grid);  // … and of the last stripe
    cutHole(1, 60, 3, 6, grid);           // … and of the first
    const FillCounts counts = fill(grid);
    EXPECT_EQ(counts.found, 0);
    EXPECT_EQ(countCells(grid, Cell::filled), 0);
}

TEST(Fill, NeverBridgesARealGap) {
    // Chin above, neck some 18 mm deeper below; between them a gap.
    VertexGrid grid = makeGrid(kCodes, kColumns, [](int code, int column) {
        return quadratic(code, column) + (code > 22 ? 16 : 0);
    });
    cutHole(21, 30, 3, 10, grid);
    const FillCounts counts = fill(grid);
    EXPECT_EQ(counts.found, 1);
    EXPECT_EQ(counts.filled, 0);
    expectCells(grid, 21, 30, 3, 10, Cell::empty);
}

TEST(Fill, ClosesNeighbouringHolesEachByItself) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    cutHole(20, 30, 3, 6, grid);
    cutHole(20, 38, 3, 6, grid);
    cutHole(25, 30, 2, 8, grid);
    const FillCounts counts = fill(grid);
    EXPECT_EQ(counts.found, 3);
    EXPECT_EQ(counts.filled, 3);
    EXPECT_EQ(countCells(grid, Cell::filled), 18 + 18 + 16);
}

TEST(Fill, KeepsWhatIsMeasuredInsideAHole) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    cutHole(20, 30, 5, 9, grid);
    const std::size_t island = grid.index(22, 34);
    grid.cell[island] = Cell::measured;
    EXPECT_EQ(fill(grid).filled, 1);
    EXPECT_EQ(grid.cell[island], Cell::measured);
    EXPECT_EQ(countCells(grid, Cell::filled), 44);
}

TEST(Fill, FindsNoHolesInASurfaceWithoutAny) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    EXPECT_EQ(fill(grid).found, 0);
    VertexGrid empty = makeGrid(kCodes, kColumns, [](int, int) { return std::nan(""); });
    EXPECT_EQ(fill(empty).found, 0);
}

TEST(Fill, GivesFilledCellsNoLight) {
    VertexGrid grid = makeGrid(kCodes, kColumns, quadratic);
    cutHole(20, 30, 4, 12, grid);
    fill(grid);
    EXPECT_EQ(grid.contrast[grid.index(21, 35)], 0);
}

}  // namespace
}  // namespace facescan
