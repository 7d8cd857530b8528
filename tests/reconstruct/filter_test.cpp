#include "reconstruct/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reconstruct/grids.h"

namespace facescan {
namespace {

using namespace test;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// A plane of stripes four pixels wide.
double plane(int code, int column) {
    return 4.0 * code + 0.2 * column;
}

/// Options under which only what a test is about happens.
Options lenient() {
    Options options;
    options.end_columns = 0;
    options.min_component = 0;
    return options;
}

int reject(const Options& options, VertexGrid& grid, bool rising = true) {
    FilterScratch scratch;
    return rejectFalseEdges(options, rising, scratch, grid);
}

TEST(StripeWidth, IsTheMedianDistanceOfNeighbouringEdges) {
    std::vector<float> scratch;
    const VertexGrid grid =
        makeGrid(20, 30, [](int code, int) { return code < 15 ? 4.5 * code : 100.0 * code; });
    EXPECT_FLOAT_EQ(medianStripeWidth(grid, scratch), 4.5f);
    const VertexGrid falling = makeGrid(20, 30, [](int code, int) { return 300 - 3.0 * code; });
    EXPECT_FLOAT_EQ(medianStripeWidth(falling, scratch), 3.0f);
}

TEST(StripeWidth, IsZeroWhereNoEdgesAreNeighbours) {
    std::vector<float> scratch;
    const VertexGrid grid =
        makeGrid(20, 30, [](int code, int) { return code % 2 ? 4.0 * code : kNothing; });
    EXPECT_EQ(medianStripeWidth(grid, scratch), 0);
}

TEST(Filter, KeepsASurface) {
    for (const bool rising : {true, false}) {
        VertexGrid grid = makeGrid(20, 40, [&](int code, int column) {
            return rising ? plane(code, column) : 100 - plane(code, column);
        });
        const std::vector<Cell> before = grid.cell;
        EXPECT_EQ(reject(lenient(), grid, rising), 0);
        EXPECT_EQ(grid.cell, before);
    }
}

TEST(Filter, EmptiesEdgesThatNoNeighbourContinues) {
    VertexGrid grid = makeGrid(30, 60, [](int code, int column) {
        return code < 12 && column < 30 ? plane(code, column) : kNothing;
    });
    const std::size_t alone = grid.index(20, 45);
    grid.cell[alone] = Cell::measured;
    grid.y[alone] = 80;
    const std::size_t astray = grid.index(6, 15);
    grid.y[astray] += 9;
    EXPECT_EQ(reject(lenient(), grid), 2);
    EXPECT_EQ(grid.cell[alone], Cell::empty);
    EXPECT_EQ(grid.cell[astray], Cell::empty);
    EXPECT_EQ(countCells(grid, Cell::measured), 11 * 30 - 1);
}

TEST(Filter, EmptiesPiecesTooSmallToBePartOfAFace) {
    // Three pieces of 5 rows: 60, 100 and 140 cells.
    const auto pieces = [](int code, int column) {
        const bool inside = (code >= 1 && code < 6 && column < 12) ||
                            (code >= 10 && code < 15 && column < 20) ||
                            (code >= 20 && code < 25 && column < 28);
        return inside ? plane(code, column) : kNothing;
    };
    VertexGrid grid = makeGrid(32, 40, pieces);
    Options options = lenient();
    options.min_component = 100;
    EXPECT_EQ(reject(options, grid), 60);
    EXPECT_EQ(grid.cell[grid.index(3, 5)], Cell::empty);
    EXPECT_EQ(grid.cell[grid.index(12, 5)], Cell::measured) << "just large enough";
    EXPECT_EQ(grid.cell[grid.index(22, 5)], Cell::measured);
}

TEST(Filter, TellsPiecesApartThatAJumpSeparates) {
    // The same rows hold a large piece and, 6 px away from it, a small one.
    VertexGrid grid = makeGrid(
        20, 40, [](int code, int column) { return plane(code, column) + (column >= 32 ? 6 : 0); });
    Options options = lenient();
    options.min_component = 200;
    EXPECT_EQ(reject(options, grid), 19 * 8);
    EXPECT_EQ(grid.cell[grid.index(10, 31)], Cell::measured);
    EXPECT_EQ(grid.cell[grid.index(10, 32)], Cell::empty);
}

TEST(Filter, TakesEdgesBesideAGapInARowForOneSurface) {
    VertexGrid grid = makeGrid(20, 40, plane);
    cutHole(1, 20, 19, 1, grid);
    Options options = lenient();
    options.min_component = 19 * 30;
    EXPECT_EQ(reject(options, grid), 0);
}

TEST(Filter, MarksTheEndsOfASurface) {
    VertexGrid grid = makeGrid(20, 40, [](int code, int column) {
        return column >= 5 && column < 30 ? plane(code, column) : kNothing;
    });
    Options options = lenient();
    options.end_columns = 2;
    EXPECT_EQ(reject(options, grid), 0);
    for (int code = 1; code < 20; ++code) {
        for (int column = 5; column < 30; ++column) {
            const bool end = column < 7 || column >= 28;
            ASSERT_EQ(grid.cell[grid.index(code, column)], end ? Cell::end : Cell::measured)
                << "column " << column;
        }
    }
}

TEST(Filter, MarksTheEndsOnBothSidesOfAJump) {
    VertexGrid grid = makeGrid(
        20, 60, [](int code, int column) { return plane(code, column) + (column >= 25 ? 7 : 0); });
    Options options = lenient();
    options.end_columns = 3;
    EXPECT_EQ(reject(options, grid), 0);
    for (const int column : {22, 23, 24, 25, 26, 27}) {
        EXPECT_EQ(grid.cell[grid.index(10, column)], Cell::end) << "column " << column;
    }
    EXPECT_EQ(grid.cell[grid.index(10, 21)], Cell::measured);
    EXPECT_EQ(grid.cell[grid.index(10, 28)], Cell::measured);
}

TEST(Filter, LeavesAnEmptyGridEmpty) {
    VertexGrid grid = makeGrid(16, 16, [](int, int) { return kNothing; });
    EXPECT_EQ(reject({}, grid), 0);
    EXPECT_EQ(countCells(grid, Cell::empty), int(grid.size()));
}

}  // namespace
}  // namespace facescan
