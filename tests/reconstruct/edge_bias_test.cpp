#include "reconstruct/edge_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reconstruct/decode.h"
#include "reconstruct/grids.h"
#include "reconstruct/stripe_image_planes.h"
#include "reconstruct/striped_scene.h"

namespace facescan {
namespace {

using namespace test;

constexpr int kWidth = 48;
constexpr int kHeight = 150;
constexpr Pattern kPattern{.bits = 8};

// A plane: the code is linear in the place, and an edge is a line of slope −kPerX / kPerY.
constexpr double kAtOrigin = 90.6;
constexpr double kPerX = 0.06;
constexpr double kPerY = 0.2;
constexpr double kSlope = -kPerX / kPerY;

double planeCode(double x, double y) {
    return kAtOrigin + kPerX * x + kPerY * y;
}

/// A reflectance that changes by the same factor from pixel to pixel, 1 in the middle.
Field exponential(double per_x, double per_y) {
    return [=](double x, double y) {
        return per_x * (x - 0.5 * kWidth) + per_y * (y - 0.5 * kHeight);
    };
}

VertexGrid decode(const FrameStack& frames, const Pattern& pattern) {
    std::vector<std::uint8_t> buffer;
    const StripeImages images =
        allStripeImages(frames.view(), wholeFrames(frames, pattern), buffer);
    PixelPlanes planes;
    fillPlanes(images, planes);
    DecodeScratch scratch;
    VertexGrid grid;
    decodeEdges(images, planes, {}, {}, scratch, grid);
    return grid;
}

void correctBias(double blur_px, const PairDrift& drift, int bits, VertexGrid& grid) {
    std::vector<std::uint8_t> scratch;
    correctEdgeBias(blur_px, drift, bits, scratch, grid);
}

struct Offset {
    double mean;
    double rms;
};

/// How far the edges lie from their true places, well inside the image.
Offset offsetFromPlane(const VertexGrid& grid) {
    double sum = 0, squares = 0;
    int count = 0;
    for (int code = 1; code < grid.codes; ++code) {
        for (int x = 4; x < grid.columns - 4; ++x) {
            const std::size_t i = grid.index(code, x);
            const double place = (code - kAtOrigin - kPerX * x) / kPerY;
            if (grid.cell[i] != Cell::measured || place < 8 || place > kHeight - 8) continue;
            const double offset = grid.y[i] - place;
            sum += offset;
            squares += offset * offset;
            ++count;
        }
    }
    EXPECT_GT(count, 500);
    return {sum / count, std::sqrt(squares / count)};
}

struct Reflectance {
    double per_x;
    double per_y;
};

class EdgeBias : public testing::TestWithParam<Reflectance> {};

TEST_P(EdgeBias, OfLensBlurIsUndone) {
    const auto [per_x, per_y] = GetParam();
    constexpr double kBlur = 1.3;
    StripedScene scene{.code = planeCode, .log_reflectance = exponential(per_x, per_y)};
    scene.camera_blur_px = kBlur;
    scene.white_level = 110;
    VertexGrid grid = decode(drawScan(scene, kPattern, kWidth, kHeight), kPattern);

    const double expected = -kBlur * kBlur * (per_y - per_x * kSlope);
    EXPECT_NEAR(offsetFromPlane(grid).mean, expected, 0.009) << "as seen";
    correctBias(kBlur, {}, kPattern.bits, grid);
    EXPECT_NEAR(offsetFromPlane(grid).mean, 0, 0.009) << "as corrected";
    EXPECT_LT(offsetFromPlane(grid).rms, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Gradients, EdgeBias,
                         testing::Values(Reflectance{0, 0.02}, Reflectance{0, -0.02},
                                         Reflectance{0.04, 0}, Reflectance{-0.04, 0},
                                         Reflectance{0.03, 0.01}));

TEST(EdgeBias, IsLeftAloneWithoutBlurAndDrift) {
    VertexGrid grid = makeGrid(32, 40, [](int code, int x) { return 4.0 * code + 0.1 * x; });
    std::fill(grid.gradient_y.begin(), grid.gradient_y.end(), 0.05f);
    const std::vector<float> before = grid.y;
    correctBias(0, {}, 5, grid);
    EXPECT_EQ(grid.y, before);
}

/// The mean offset of one edge over the columns; not a number where it lies near the border.
double offsetOfEdge(const VertexGrid& grid, int code) {
    double sum = 0;
    int count = 0;
    for (int x = 4; x < grid.columns - 4; ++x) {
        const double place = (code - kAtOrigin - kPerX * x) / kPerY;
        if (place < 8 || place > kHeight - 8) return std::nan("");
        sum += grid.y[grid.index(code, x)] - place;
        ++count;
    }
    return sum / count;
}

/// A scan in which the surface slides along itself from each pattern to its complement: its
/// reflectance moves, its stripes stay.
FrameStack drawSliding(StripedScene scene, const Reflectance& gradient, const ImagePoint& drift) {
    FrameStack frames = blackFrames(kPattern, kWidth, kHeight);
    const Field reflectance = exponential(gradient.per_x, gradient.per_y);
    for (int pair = 0; pair < kPattern.bits; ++pair) {
        for (const bool complement : {false, true}) {
            const double part = complement ? 0.5 : -0.5;
            scene.log_reflectance = [=](double x, double y) {
                return reflectance(x - part * drift.column, y - part * drift.y);
            };
            drawFrame(scene, kPattern, pair, complement, frames);
        }
    }
    return frames;
}

TEST(EdgeBias, OfDriftWithinAPairIsUndone) {
    // The pattern's frame or its complement gains on the other. An edge after which the one that
    // gains is lit moves the one way, an edge before which it is lit the other way.
    const Reflectance gradient{0.05, 0.01};
    const ImagePoint drift{0.6f, 0.3f};
    const StripedScene scene{.code = planeCode, .white_level = 70};
    const VertexGrid seen = decode(drawSliding(scene, gradient, drift), kPattern);
    VertexGrid corrected = seen;
    PairDrift pairs{};
    pairs.fill(drift);
    correctBias(scene.camera_blur_px, pairs, kPattern.bits, corrected);

    int edges = 0;
    double corrected_squares = 0;
    double seen_squares = 0;
    for (int code = 1; code < kPattern.stripes(); ++code) {
        const double offset = offsetOfEdge(corrected, code);
        if (std::isnan(offset)) continue;
        // What is left is the rounding of the frames to whole grey levels.
        EXPECT_LT(std::fabs(offset), 0.016) << "edge " << code;
        corrected_squares += offset * offset;
        seen_squares += offsetOfEdge(seen, code) * offsetOfEdge(seen, code);
        ++edges;
    }
    EXPECT_LT(corrected_squares, 0.25 * seen_squares);
    EXPECT_GT(edges, 20);
}

TEST(PairDrift, IsTheMotionFromPatternToComplement) {
    // A steady drift of (0.3, -0.2) px a frame.
    for (const FrameOrder order : {FrameOrder::interleaved, FrameOrder::grouped}) {
        const Pattern pattern{.bits = 6, .order = order};
        const int between_pairs = order == FrameOrder::interleaved ? 2 : 1;
        const int within_a_pair = order == FrameOrder::interleaved ? 1 : 6;
        std::array<ImageMotion, kMaxBits> motions{};
        for (int pair = 0; pair < 6; ++pair) {
            const float frames = float(between_pairs * (pair - pattern.finestPair()));
            motions[pair] = {.column = 0.3f * frames, .y = -0.2f * frames};
        }
        const PairDrift drift = driftWithinPairs(pattern, motions);
        for (int pair = 0; pair < 6; ++pair) {
            EXPECT_NEAR(drift[pair].column, 0.3 * within_a_pair, 1e-5);
            EXPECT_NEAR(drift[pair].y, -0.2 * within_a_pair, 1e-5);
        }
    }
}

}  // namespace
}  // namespace facescan
