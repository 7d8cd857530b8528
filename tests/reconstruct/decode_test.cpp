#include "reconstruct/decode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reconstruct/grids.h"
#include "reconstruct/stripe_image_planes.h"
#include "reconstruct/striped_scene.h"

namespace facescan {
namespace {

using namespace test;

struct Decoded {
    DecodeCounts counts;
    VertexGrid grid;
};

Decoded decode(const FrameStack& frames, const Pattern& pattern, const Options& options = {}) {
    std::vector<std::uint8_t> buffer;
    const StripeImages images =
        allStripeImages(frames.view(), wholeFrames(frames, pattern), buffer);
    PixelPlanes planes;
    fillPlanes(images, planes);
    DecodeScratch scratch;
    Decoded decoded;
    decoded.counts = decodeEdges(images, planes, {}, options, scratch, decoded.grid);
    return decoded;
}

/// The code of a plane: linear in the place.
struct LinearCode {
    double at_origin;
    double per_x;
    double per_y;

    double operator()(double x, double y) const { return at_origin + per_x * x + per_y * y; }
    double edgeAt(int code, double x) const { return (code - at_origin - per_x * x) / per_y; }
};

/// Expects every edge that the code shows well inside the image once, at its place, and no other.
/// The place is off by some hundredths of a pixel, since a blurred edge is no straight line.
void expectEdgesOf(const LinearCode& code, int height, const VertexGrid& grid) {
    constexpr double kMargin = 3;
    double worst = 0;
    double squares = 0;
    int count = 0;
    for (int edge = 1; edge < grid.codes; ++edge) {
        for (int x = 0; x < grid.columns; ++x) {
            const double place = code.edgeAt(edge, x);
            const std::size_t i = grid.index(edge, x);
            if (place > kMargin && place < height - 1 - kMargin) {
                ASSERT_EQ(grid.cell[i], Cell::measured) << "edge " << edge << ", column " << x;
                const double offset = std::fabs(grid.y[i] - place);
                worst = std::max(worst, offset);
                squares += offset * offset;
                ++count;
            } else if (place < -kMargin || place > height - 1 + kMargin) {
                ASSERT_EQ(grid.cell[i], Cell::empty) << "edge " << edge << ", column " << x;
            }
        }
    }
    EXPECT_LT(worst, 0.08);
    EXPECT_LT(std::sqrt(squares / count), 0.04);
}

class DecodeOfBits : public testing::TestWithParam<int> {};

TEST_P(DecodeOfBits, FindsEveryEdgeOnceAtItsPlace) {
    const Pattern pattern{.bits = GetParam()};
    constexpr int kHeight = 220;
    // Around the middle of the range, where all bits change.
    const LinearCode code{pattern.stripes() / 2 - 27.3, 0.031, 0.25};
    for (const double sign : {1.0, -1.0}) {
        const LinearCode mounted{sign > 0 ? code.at_origin : pattern.stripes() - code.at_origin,
                                 sign * code.per_x, sign * code.per_y};
        const FrameStack frames = drawScan({.code = mounted}, pattern, 33, kHeight);
        const Decoded decoded = decode(frames, pattern);
        EXPECT_EQ(decoded.counts.rising, sign > 0);
        EXPECT_EQ(decoded.counts.found, decoded.counts.decoded);
        EXPECT_EQ(decoded.counts.decoded, countCells(decoded.grid, Cell::measured));
        EXPECT_EQ(decoded.grid.codes, pattern.stripes());
        EXPECT_EQ(decoded.grid.columns, 33);
        expectEdgesOf(mounted, kHeight, decoded.grid);
    }
}

INSTANTIATE_TEST_SUITE_P(Bits, DecodeOfBits, testing::Range(kMinBits, kMaxBits + 1));

TEST(Decode, DropsCodesThatAnImageOfFewRowsCannotTellApart) {
    // Twelve bits in twenty rows: the grid holds twenty codes for each row, and none beyond.
    const Pattern pattern{.bits = 12};
    for (const double at_origin : {100.4, 3000.4}) {
        const LinearCode code{at_origin, 0.01, 0.25};
        const Decoded decoded = decode(drawScan({.code = code}, pattern, 24, 20), pattern);
        EXPECT_EQ(decoded.grid.codes, 400);
        EXPECT_GT(decoded.counts.decoded, 0);
        if (at_origin < 400) {
            expectEdgesOf(code, 20, decoded.grid);
        } else {
            EXPECT_EQ(countCells(decoded.grid, Cell::measured), 0);
        }
    }
}

TEST(Decode, FindsTheSameEdgesInAnImageOnItsSide) {
    const LinearCode code{100.4, 0.02, 0.24};
    const Pattern upright{.bits = 8, .axis = CodeAxis::y};
    const Pattern sideways{.bits = 8, .axis = CodeAxis::x, .order = FrameOrder::grouped};
    const Field turned = [=](double x, double y) { return code(y, x); };
    const Decoded a = decode(drawScan({.code = code}, upright, 40, 120), upright);
    const Decoded b = decode(drawScan({.code = turned}, sideways, 120, 40), sideways);
    EXPECT_EQ(a.grid.cell, b.grid.cell);
    EXPECT_EQ(a.grid.y, b.grid.y);
}

TEST(Decode, FindsStripesFromTwoToTenPixelsWide) {
    const Pattern pattern{.bits = 8};
    for (const double width : {2.2, 3.0, 5.0, 10.0}) {
        const LinearCode code{90.6, 0.1 / width, 1 / width};
        const Decoded decoded = decode(drawScan({.code = code}, pattern, 24, 150), pattern);
        expectEdgesOf(code, 150, decoded.grid);
    }
}

TEST(Decode, IsNotMovedByRoomLightOrReflectance) {
    const LinearCode code{90.6, 0.03, 0.25};
    StripedScene scene{.code = code};
    scene.log_reflectance = [](double, double) { return std::log(0.4); };
    scene.ambient_level = 250;
    const Pattern pattern{.bits = 8};
    expectEdgesOf(code, 150, decode(drawScan(scene, pattern, 24, 150), pattern).grid);
}

TEST(Decode, MeasuresTheLightAroundAnEdge) {
    const LinearCode code{90.6, 0, 0.25};
    StripedScene scene{.code = code};
    scene.log_reflectance = [](double x, double y) { return 0.01 * x - 0.006 * y; };
    scene.white_level = 150;
    scene.camera_blur_px = 0.2;
    const Pattern pattern{.bits = 8};
    const FrameStack frames = drawScan(scene, pattern, 40, 100);
    const VertexGrid grid = decode(frames, pattern).grid;
    for (int edge = 93; edge < 113; ++edge) {
        for (int x = 3; x < 37; ++x) {
            const std::size_t i = grid.index(edge, x);
            ASSERT_EQ(grid.cell[i], Cell::measured);
            // Between the two frames of a pair the place gets the light of one lit stripe and of
            // one dark one.
            const double reflectance = std::exp(scene.log_reflectance(x, grid.y[i]));
            const double brightness = 1.05 * 150 * reflectance;
            EXPECT_NEAR(std::fabs(grid.drift_gain[i]) * 2 * grid.contrast[i], brightness, 2.5);
            EXPECT_NEAR(grid.gradient_x[i], 0.01, 0.006);
            EXPECT_NEAR(grid.gradient_y[i], -0.006, 0.006);
            const int pair = pairOfEdge(edge, pattern.bits);
            const auto difference = [&](int y) {
                const FrameStackView view = frames.view();
                const std::size_t pixel = std::size_t(y) * view.row_stride + x;
                return view.frame(2 * pair)[pixel] - view.frame(2 * pair + 1)[pixel];
            };
            const int y = int(grid.y[i]);
            const int change = difference(y + 1) - difference(y);
            EXPECT_NEAR(grid.contrast[i], std::abs(change), 3.0);
            EXPECT_EQ(grid.drift_gain[i] > 0, change > 0) << "darker in the second frame";
        }
    }
}

/// Two codewords, one above the other: the place between them shows every pair in which they
/// differ.
FrameStack twoCodewords(const Pattern& pattern, std::uint32_t above, std::uint32_t below) {
    FrameStack frames = blackFrames(pattern, 16, 16);
    for (int pair = 0; pair < pattern.bits; ++pair) {
        for (int y = 0; y < 16; ++y) {
            const std::uint32_t codeword = y < 8 ? above : below;
            const bool lit = codeword >> (pattern.bits - 1 - pair) & 1u;
            const int frame = pattern.frameIndex(pair, !lit);
            std::fill_n(frames.pixels.begin() + (frame * 16 + y) * 16, 16, std::uint8_t(200));
        }
    }
    return frames;
}

TEST(Decode, NamesAnEdgeOnlyBetweenNeighbouringStripes) {
    const Pattern pattern{.bits = 6};
    for (int above = 0; above < 64; ++above) {
        for (int bit = 0; bit < 6; ++bit) {
            const std::uint32_t codeword = grayCodeword(above);
            const int below = int(grayStripe(codeword ^ (1u << bit)));
            const Decoded decoded =
                decode(twoCodewords(pattern, codeword, codeword ^ (1u << bit)), pattern);
            EXPECT_EQ(decoded.counts.found, 16);
            const bool neighbours = std::abs(above - below) == 1;
            EXPECT_EQ(decoded.counts.decoded, neighbours ? 16 : 0)
                << "stripes " << above << " and " << below;
            EXPECT_EQ(countCells(decoded.grid, Cell::measured), neighbours ? 16 : 0);
            if (!neighbours) continue;
            EXPECT_EQ(decoded.counts.rising, below > above);
            const std::size_t cell = decoded.grid.index(std::max(above, below), 5);
            EXPECT_NEAR(decoded.grid.y[cell], 7.5, 1e-3);
        }
    }
}

TEST(Decode, FindsNoEdgeWhereASurfaceEnds) {
    const Pattern pattern{.bits = 6};
    for (int above = 0; above < 64; ++above) {
        for (int below = 0; below < 64; ++below) {
            if (std::abs(above - below) <= 3) continue;
            const FrameStack frames =
                twoCodewords(pattern, grayCodeword(above), grayCodeword(below));
            EXPECT_EQ(decode(frames, pattern).counts.decoded, 0)
                << "stripes " << above << " and " << below;
        }
    }
}

TEST(Decode, NamesAnEdgeBesideAPixelThatNoiseMisreads) {
    const Pattern pattern{.bits = 6};
    for (int above = 1; above < 62; ++above) {
        for (int pair = 0; pair < pattern.finestPair(); ++pair) {
            if (pair == pairOfEdge(above + 1, pattern.bits)) continue;
            FrameStack frames = twoCodewords(pattern, grayCodeword(above), grayCodeword(above + 1));
            // The next edge says, too, which way the code runs.
            for (int k = 0; k < pattern.bits; ++k) {
                for (const bool complement : {false, true}) {
                    const bool bright = pattern.lit(k, complement, std::uint32_t(above + 2));
                    const int frame = pattern.frameIndex(k, complement);
                    std::fill_n(frames.pixels.begin() + (frame * 16 + 12) * 16, 4 * 16,
                                std::uint8_t(bright ? 200 : 0));
                }
            }
            // The last row above the edge reads the other way, as faintly as can be.
            const bool lit = pattern.lit(pair, false, above);
            for (const bool complement : {false, true}) {
                const int frame = pattern.frameIndex(pair, complement);
                std::fill_n(frames.pixels.begin() + (frame * 16 + 7) * 16, 16,
                            std::uint8_t(lit == complement ? 101 : 100));
            }
            const Decoded decoded = decode(frames, pattern);
            const std::size_t cell = decoded.grid.index(above + 1, 5);
            EXPECT_EQ(decoded.grid.cell[cell], Cell::measured)
                << "stripe " << above << ", pair " << pair;
        }
    }
}

TEST(Decode, PassesOverPixelsThatTheLightDoesNotReach) {
    const LinearCode code{90.6, 0.03, 0.25};
    StripedScene scene{.code = code, .white_level = 9, .dark_share = 0};
    const Pattern pattern{.bits = 8};
    const FrameStack frames = drawScan(scene, pattern, 24, 100);
    Options options;
    options.min_modulation = 10;
    EXPECT_EQ(decode(frames, pattern, options).counts.found, 0);
    options.min_modulation = 7;
    EXPECT_GT(decode(frames, pattern, options).counts.decoded, 400);
}

TEST(Decode, DropsEdgesThatRunAgainstTheDevice) {
    StripedScene scene;
    scene.code = [](double x, double y) { return x < 45 ? 90 + 0.25 * y : 130 - 0.25 * y; };
    const Pattern pattern{.bits = 8};
    const Decoded decoded = decode(drawScan(scene, pattern, 60, 100), pattern);
    EXPECT_TRUE(decoded.counts.rising);
    for (int edge = 1; edge < 256; ++edge) {
        for (int x = 48; x < 60; ++x) {
            ASSERT_EQ(decoded.grid.cell[decoded.grid.index(edge, x)], Cell::empty);
        }
    }
    EXPECT_EQ(decoded.grid.cell[decoded.grid.index(100, 20)], Cell::measured);
}

TEST(Decode, KeepsTheEdgeOfHigherContrastWhereAColumnShowsItTwice) {
    // The codes 95 … 110 are seen on a bright surface and again, below, on a dark one.
    StripedScene scene;
    scene.code = [](double, double y) { return y < 80.5 ? 90.1 + 0.25 * y : 74.9 + 0.25 * y; };
    scene.log_reflectance = [](double, double y) { return y < 80.5 ? 0.0 : -1.0; };
    const Pattern pattern{.bits = 8};
    const VertexGrid grid = decode(drawScan(scene, pattern, 20, 150), pattern).grid;
    for (int edge = 96; edge < 110; ++edge) {
        EXPECT_NEAR(grid.y[grid.index(edge, 10)], (edge - 90.1) / 0.25, 0.04);
    }
    EXPECT_NEAR(grid.y[grid.index(111, 10)], (111 - 74.9) / 0.25, 0.06) << "seen below alone";
}

TEST(Decode, FindsNothingInFramesWithoutAPattern) {
    const Pattern pattern{.bits = 8};
    FrameStack frames = blackFrames(pattern, 40, 40);
    EXPECT_EQ(decode(frames, pattern).counts.found, 0);
    std::fill(frames.pixels.begin(), frames.pixels.end(), std::uint8_t(255));
    const Decoded white = decode(frames, pattern);
    EXPECT_EQ(white.counts.found, 0);
    EXPECT_EQ(countCells(white.grid, Cell::empty), int(white.grid.size()));
}

}  // namespace
}  // namespace facescan
