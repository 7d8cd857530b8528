#include "reconstruct/surface_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "reconstruct/grids.h"
#include "reconstruct/pinhole_scanner.h"

namespace facescan {
namespace {

using namespace test;
using Eigen::Vector3d;

/// A small rigid motion about a centre, as a face makes it during a scan.
struct Motion {
    Vector3d translation = Vector3d::Zero();  ///< mm
    Vector3d rotation = Vector3d::Zero();     ///< rad

    Vector3d apply(const Vector3d& point, const Vector3d& centre) const {
        return point + translation + rotation.cross(point - centre);
    }
    Vector3d undo(const Vector3d& point, const Vector3d& centre) const {
        const Vector3d lever = point - centre - translation;
        return centre + lever - rotation.cross(lever);
    }
};

/// A grid with its points.
class Calibrated {
public:
    Calibrated(const GridCalibration& calibration, const VertexGrid& grid)
        : calibration_(calibration), grid_(grid) {
        calibrateCells(calibration, grid, points_);
        findReferencePlanes(calibration, grid, points_, planes_);
    }

    MeasuredSurface surface() const { return {calibration_, grid_, points_, planes_}; }

private:
    const GridCalibration& calibration_;
    VertexGrid grid_;
    PointPlanes points_;
    ReferencePlanes planes_;
};

/// A surface that moves from pair to pair, seen by an ideal scanner.
class MovingSurface {
public:
    MovingSurface(const Surface& surface, const std::array<Motion, kMaxBits>& motions)
        : surface_(surface), motions_(motions) {
        scanner_.width = 200;
        scanner_.height = 240;
        scan_ = scanner_.describe(FrameOrder::interleaved, kNearest, kFarthest);
        calibration_.prepare(scan_, scanner_.width, false);
        const Vector3d axis(0, 0, 1);
        centre_ = surface_(axis) * axis;
    }

    /// The edges as they are seen: each where the surface of its pair's moment shows it.
    VertexGrid seen() const { return grid(motions_); }
    /// The edges as they would be seen at the reference moment.
    VertexGrid still() const { return grid({}); }

    /// The motion of each pair's image, as the camera sees it.
    std::array<ImageMotion, kMaxBits> imageMotions() const {
        std::array<ImageMotion, kMaxBits> images{};
        for (int pair = 0; pair < scanner_.bits; ++pair) {
            const Motion& motion = motions_[pair];
            const Vector3d moved = motion.apply(centre_, centre_);
            const Eigen::Vector2d shift = scanner_.project(moved) - scanner_.project(centre_);
            images[pair] = {.column = float(shift.x()),
                            .y = float(shift.y()),
                            .turn = float(motion.rotation.z()),
                            .scale = float(centre_.z() / moved.z() - 1)};
        }
        return images;
    }

    /// The estimate from the grid and the motion of the image.
    SurfaceMotion estimate(const VertexGrid& grid) const {
        return estimate(Calibrated(calibration_, grid));
    }

    /// Where a known motion of all pairs but the finest moves the edges.
    VertexGrid movedBy(const RigidMotion& rigid, const VertexGrid& grid) const {
        const Calibrated calibrated(calibration_, grid);
        SurfaceMotion motion;
        motion.centre = {float(centre_.x()), float(centre_.y()), float(centre_.z())};
        std::fill_n(motion.pairs.begin(), scanner_.bits - 1, rigid);
        VertexGrid moved = grid;
        compensateMotion(calibrated.surface(), motion, scanner_.bits, moved);
        return moved;
    }

    VertexGrid compensated(const VertexGrid& grid) const {
        const Calibrated calibrated(calibration_, grid);
        VertexGrid moved = grid;
        compensateMotion(calibrated.surface(), estimate(calibrated), scanner_.bits, moved);
        return moved;
    }

private:
    static constexpr double kNearest = 360;  // mm
    static constexpr double kFarthest = 460;

    SurfaceMotion estimate(const Calibrated& calibrated) const {
        const MeasuredSurface surface = calibrated.surface();
        AlignmentEquations scratch;
        return estimateSurfaceMotion(surface, calibration_, scanner_.bits,
                                     findMiddle(surface.grid, surface.points), imageMotions(),
                                     scratch);
    }

    /// How far a point of the edge's line lies behind the moved surface, mm of Z.
    double depthBehind(const Motion& motion, int code, int column, double y) const {
        const Point p = calibration_.at(code, column, float(y));
        const Vector3d back = motion.undo({p.x, p.y, p.z}, centre_);
        return back.z() - surface_(back / back.z());
    }

    VertexGrid grid(const std::array<Motion, kMaxBits>& motions) const {
        return makeGrid(1 << scanner_.bits, scanner_.width, [&](int code, int column) {
            const Motion& motion = motions[pairOfEdge(code, scanner_.bits)];
            double low = 0;
            double high = scanner_.height - 1;
            const bool front = depthBehind(motion, code, column, low) < 0;
            if (front == (depthBehind(motion, code, column, high) < 0)) return std::nan("");
            for (int step = 0; step < 30; ++step) {
                const double middle = 0.5 * (low + high);
                const bool same = (depthBehind(motion, code, column, middle) < 0) == front;
                (same ? low : high) = middle;
            }
            const float z = calibration_.at(code, column, float(low)).z;
            return z > kNearest && z < kFarthest ? low : std::nan("");
        });
    }

    PinholeScanner scanner_;
    ScanDescription scan_;
    GridCalibration calibration_;
    Surface surface_;
    std::array<Motion, kMaxBits> motions_;
    Vector3d centre_;
};

struct Spread {
    double rms;
    double worst;
};

/// The difference of two grids, px, borders left out.
Spread difference(const VertexGrid& a, const VertexGrid& b) {
    double squares = 0, worst = 0;
    int count = 0;
    for (int code = 4; code + 4 < a.codes; ++code) {
        for (int column = 8; column + 8 < a.columns; ++column) {
            bool inside = true;
            for (const int step : {-3, -1, 0, 1, 3}) {
                const std::size_t i = a.index(code + step, column);
                inside = inside && a.cell[i] == Cell::measured && b.cell[i] == Cell::measured;
            }
            if (!inside) continue;
            const std::size_t i = a.index(code, column);
            const double offset = std::fabs(a.y[i] - b.y[i]);
            squares += offset * offset;
            worst = std::max(worst, offset);
            ++count;
        }
    }
    EXPECT_GT(count, 3000);
    return {std::sqrt(squares / count), worst};
}

/// A motion that grows linearly from the reference moment back to the first pair.
std::array<Motion, kMaxBits> steady(const Vector3d& translation, const Vector3d& rotation) {
    std::array<Motion, kMaxBits> motions{};
    for (int pair = 0; pair < 8; ++pair) {
        const double part = (7 - pair) / 7.0;
        motions[pair] = {part * translation, part * rotation};
    }
    return motions;
}

struct NamedMotion {
    const char* name;
    Vector3d translation;
    Vector3d rotation;
};

void PrintTo(const NamedMotion& motion, std::ostream* out) {
    *out << motion.name;
}

class SurfaceMotionOf : public testing::TestWithParam<NamedMotion> {};

Surface head() {
    return sphereSurface({4, -6, 470}, 75);
}

TEST_P(SurfaceMotionOf, AHeadIsUndone) {
    const MovingSurface scene(head(), steady(GetParam().translation, GetParam().rotation));
    const VertexGrid still = scene.still();
    const VertexGrid seen = scene.seen();
    const Spread before = difference(seen, still);
    const Spread after = difference(scene.compensated(seen), still);
    EXPECT_GT(before.rms, 0.007) << "there is something to undo";
    EXPECT_LT(after.rms, 0.4 * before.rms);
    EXPECT_LT(after.rms, 0.004);
    EXPECT_LT(after.worst, 0.06);
}

INSTANTIATE_TEST_SUITE_P(
    Motions, SurfaceMotionOf,
    testing::Values(NamedMotion{"Sideways", {0.4, 0, 0}, {0, 0, 0}},
                    NamedMotion{"Up", {0, -0.4, 0}, {0, 0, 0}},
                    NamedMotion{"Nearer", {0, 0, -0.5}, {0, 0, 0}},
                    // About a neck 100 mm behind the face.
                    NamedMotion{"Nodding", {0, 0.4, 0}, {0.004, 0, 0}},
                    NamedMotion{"Turning", {-0.4, 0, 0}, {0, 0.004, 0}},
                    NamedMotion{"AllAtOnce", {0.3, -0.2, 0.3}, {0.002, -0.002, 0.002}}),
    testing::PrintToStringParamName());

TEST(SurfaceMotion, LeavesAStillSurfaceWhereItIs) {
    const MovingSurface scene(head(), {});
    const VertexGrid still = scene.still();
    EXPECT_LT(difference(scene.compensated(still), still).worst, 0.04);
}

TEST(SurfaceMotion, KeepsTheFinestPairsEdges) {
    const MovingSurface scene(head(), steady({0.3, -0.2, 0.3}, {0.002, 0, 0}));
    const VertexGrid seen = scene.seen();
    const VertexGrid compensated = scene.compensated(seen);
    for (int code = 1; code < seen.codes; code += 2) {
        for (int column = 0; column < seen.columns; ++column) {
            const std::size_t i = seen.index(code, column);
            ASSERT_EQ(seen.y[i], compensated.y[i]);
        }
    }
}

TEST(SurfaceMotion, OfAPlaneAlongItselfIsKnownFromTheImage) {
    // Nothing that the surface's shape tells; the edges do not move either.
    const MovingSurface scene(planeSurface(400, 0, 0), steady({0.5, 0.3, 0}, {0, 0, 0}));
    const VertexGrid seen = scene.seen();
    const SurfaceMotion motion = scene.estimate(seen);
    for (int pair = 0; pair < 8; ++pair) {
        const double part = (7 - pair) / 7.0;
        EXPECT_NEAR(motion.pairs[pair].translation[0], -0.5 * part, 0.01);
        EXPECT_NEAR(motion.pairs[pair].translation[1], -0.3 * part, 0.01);
        EXPECT_NEAR(motion.pairs[pair].translation[2], 0, 0.01);
    }
    EXPECT_LT(difference(scene.compensated(seen), seen).worst, 0.02);
}

TEST(SurfaceMotion, OfAHeadThatTiltsIsKnownFromTheImage) {
    // A sphere that turns about the line of sight keeps its shape.
    const MovingSurface scene(head(), steady({0.5, 0, 0}, {0, 0, 0.006}));
    const SurfaceMotion motion = scene.estimate(scene.seen());
    for (int pair = 0; pair < 8; ++pair) {
        EXPECT_NEAR(motion.pairs[pair].rotation[2], -0.006 * (7 - pair) / 7.0, 3e-4);
    }
}

/// A plane, and before the edge of a code another surface.
struct Jump {
    static constexpr int kFirst = 110;  ///< the first code of the plane

    MovingSurface scene{planeSurface(400, 0.2, 0.1), {}};
    VertexGrid plane = scene.still();
    VertexGrid grid = plane;

    Jump() {
        for (int code = 1; code < kFirst; ++code) {
            for (int column = 0; column < grid.columns; ++column) {
                grid.y[grid.index(code, column)] -= 9;
            }
        }
    }
};

constexpr RigidMotion kNearer{{0.1f, 0.2f, -0.4f}, {0, 0, 0}};

TEST(SurfaceMotion, BesideAJumpIsThatOfTheEdgesOwnSurface) {
    const Jump jump;
    const VertexGrid expected = jump.scene.movedBy(kNearer, jump.plane);
    const VertexGrid moved = jump.scene.movedBy(kNearer, jump.grid);
    for (int column = 20; column < 180; ++column) {
        const std::size_t i = jump.grid.index(Jump::kFirst, column);
        ASSERT_EQ(jump.grid.cell[i], Cell::measured);
        ASSERT_GT(std::fabs(expected.y[i] - jump.plane.y[i]), 0.2f);
        ASSERT_NEAR(moved.y[i], expected.y[i], 0.02) << "column " << column;
    }
}

TEST(SurfaceMotion, BesideACreaseInARowIsThatOfTheEdgesOwnSurface) {
    // The row before the first of the plane falls away from column 100 on.
    Jump jump;
    VertexGrid creased = jump.plane;
    for (int column = 100; column < creased.columns; ++column) {
        creased.y[creased.index(Jump::kFirst - 1, column)] -= 1.5f * float(column - 99);
    }
    const VertexGrid expected = jump.scene.movedBy(kNearer, jump.plane);
    const VertexGrid moved = jump.scene.movedBy(kNearer, creased);
    for (int column = 92; column < 108; ++column) {
        const std::size_t i = creased.index(Jump::kFirst, column);
        ASSERT_NEAR(moved.y[i], expected.y[i], 0.1) << "column " << column;
    }
}

TEST(SurfaceMotion, DropsTheOutlineOfWhatMoved) {
    // Where a surface ends at another that moved, the edge between them belongs to neither: it
    // lies too near to the next.
    Jump jump;
    const float near = 2;
    for (int column = 0; column < jump.grid.columns; ++column) {
        const std::size_t i = jump.grid.index(Jump::kFirst, column);
        jump.grid.y[i] = jump.grid.y[i + jump.grid.columns] - near;
    }
    const VertexGrid still = jump.scene.movedBy({}, jump.grid);
    const VertexGrid moved = jump.scene.movedBy(kNearer, jump.grid);
    for (int column = 20; column < 180; ++column) {
        const std::size_t i = jump.grid.index(Jump::kFirst, column);
        ASSERT_EQ(still.cell[i], Cell::measured) << "column " << column;
        ASSERT_EQ(moved.cell[i], Cell::empty) << "column " << column;
        ASSERT_EQ(moved.cell[i + 2 * jump.grid.columns], Cell::measured) << "column " << column;
    }
}

TEST(SurfaceMotion, OfNothingIsNone) {
    PinholeScanner scanner;
    GridCalibration calibration;
    calibration.prepare(scanner.describe(FrameOrder::interleaved, 360, 460), scanner.width, false);
    VertexGrid grid = makeGrid(256, scanner.width, [](int, int) { return std::nan(""); });
    const Calibrated calibrated(calibration, grid);
    const SurfaceMiddle middle = findMiddle(grid, calibrated.surface().points);
    EXPECT_EQ(middle.code, 0);
    AlignmentEquations scratch;
    const SurfaceMotion motion =
        estimateSurfaceMotion(calibrated.surface(), calibration, 8, middle, {}, scratch);
    compensateMotion(calibrated.surface(), motion, 8, grid);
    EXPECT_EQ(countCells(grid, Cell::empty), int(grid.size()));
}

TEST(SurfaceMiddle, IsTheCellNearestToTheCentreOfGravity) {
    const VertexGrid grid = makeGrid(32, 41, [](int code, int) { return 4.0 * code; });
    const SurfaceMiddle middle = findMiddle(grid, flatPoints(grid));
    EXPECT_EQ(middle.code, 16);
    EXPECT_EQ(middle.column, 20);
    EXPECT_EQ(middle.place.column, 20);
    EXPECT_EQ(middle.place.y, 64);
}

}  // namespace
}  // namespace facescan
