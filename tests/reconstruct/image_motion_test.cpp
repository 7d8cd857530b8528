#include "reconstruct/image_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "reconstruct/grids.h"
#include "reconstruct/stripe_image_planes.h"
#include "reconstruct/striped_scene.h"

namespace facescan {
namespace {

using namespace test;

constexpr int kWidth = 250;
constexpr int kHeight = 280;
constexpr Pattern kPattern{.bits = 4};
constexpr ImagePoint kMiddle{118, 146};

/// A smooth, irregular picture around grey level 100.
double texture(double x, double y) {
    return 100 + 22 * std::sin(0.21 * x + 0.05 * y) + 20 * std::sin(0.18 * y - 0.07 * x + 1) +
           16 * std::sin(0.13 * (x + y)) + 14 * std::cos(0.11 * x - 0.16 * y);
}

/// Where a point of the picture comes from: the inverse of the similarity.
ImagePoint origin(const ImageMotion& motion, double x, double y) {
    const double px = x - kMiddle.column - motion.column;
    const double py = y - kMiddle.y - motion.y;
    const double cosine = std::cos(motion.turn);
    const double sine = std::sin(motion.turn);
    const double size = 1 + motion.scale;
    return {float(kMiddle.column + (cosine * px + sine * py) / size),
            float(kMiddle.y + (cosine * py - sine * px) / size)};
}

using Motions = std::array<ImageMotion, kMaxBits>;
using Picture = std::function<double(int pair, double x, double y)>;

FrameStack drawPairs(const Picture& picture) {
    FrameStack frames = blackFrames(kPattern, kWidth, kHeight);
    for (int pair = 0; pair < kPattern.bits; ++pair) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                // Light and dark stripes make up the picture together.
                const double level = 2 * picture(pair, x, y);
                const double lit = (y / 5 + pair) % 2 ? 0.9 : 0.1;
                for (const bool complement : {false, true}) {
                    const double share = complement ? 1 - lit : lit;
                    const std::size_t frame = kPattern.frameIndex(pair, complement);
                    frames.pixels[(frame * kHeight + y) * kWidth + x] =
                        std::uint8_t(std::lround(level * share));
                }
            }
        }
    }
    return frames;
}

Picture moving(const Motions& motions) {
    return [motions](int pair, double x, double y) {
        const ImagePoint from = origin(motions[pair], x, y);
        return texture(from.column, from.y);
    };
}

/// A surface on the columns from 10 to `last`, its edges 3 px apart.
VertexGrid surfaceUpTo(int last = kWidth - 11) {
    return makeGrid(92, kWidth, [=](int code, int column) {
        return column >= 10 && column <= last ? 3.0 * code : std::nan("");
    });
}

Motions estimate(const FrameStack& frames, const VertexGrid& grid) {
    std::vector<std::uint8_t> buffer;
    const StripeImages images =
        allStripeImages(frames.view(), wholeFrames(frames, kPattern), buffer);
    ImageMotionScratch scratch;
    HalfImages halves;
    beginHalfImages(images, halves);
    for (int pair = 0; pair < images.bits; ++pair) {
        for (int y = 0; y < images.height / 2; ++y) addRow(images, pair, y, halves);
    }
    return estimateImageMotion(halves, grid, kMiddle, scratch);
}

void expectMotions(const Motions& motions, const Motions& expected) {
    for (int pair = 0; pair < kPattern.bits; ++pair) {
        EXPECT_NEAR(motions[pair].column, expected[pair].column, 0.02) << "pair " << pair;
        EXPECT_NEAR(motions[pair].y, expected[pair].y, 0.02) << "pair " << pair;
        EXPECT_NEAR(motions[pair].turn, expected[pair].turn, 3e-4) << "pair " << pair;
        EXPECT_NEAR(motions[pair].scale, expected[pair].scale, 3e-4) << "pair " << pair;
    }
}

Motions someMotions() {
    Motions motions{};
    motions[0] = {.column = 2.4f, .y = -1.9f, .turn = 0.008f, .scale = -0.006f};
    motions[1] = {.column = 1.7f, .y = -1.1f, .turn = -0.004f, .scale = 0.005f};
    motions[2] = {.column = 0.6f, .y = 0.35f, .turn = 0.002f, .scale = 0.003f};
    return motions;
}

TEST(ImageMotion, OfAStillSceneIsZero) {
    expectMotions(estimate(drawPairs(moving({})), surfaceUpTo()), {});
}

TEST(ImageMotion, IsFoundToAFiftiethOfAPixel) {
    for (const float shift : {0.1f, 0.5f, 1.3f, 3.0f}) {
        Motions motions{};
        for (int pair = 0; pair < 3; ++pair) {
            motions[pair].column = shift * (1 - float(pair) / 3);
            motions[pair].y = -0.6f * motions[pair].column;
        }
        expectMotions(estimate(drawPairs(moving(motions)), surfaceUpTo()), motions);
    }
}

TEST(ImageMotion, KnowsTurnsAndChangesOfSize) {
    expectMotions(estimate(drawPairs(moving(someMotions())), surfaceUpTo()), someMotions());
}

TEST(ImageMotion, IsBlindToChangesOfLight) {
    const Picture picture = [](int pair, double x, double y) {
        return moving(someMotions())(pair, x, y) * (1 - 0.08 * pair) + 5 * pair;
    };
    expectMotions(estimate(drawPairs(picture), surfaceUpTo()), someMotions());
}

TEST(ImageMotion, IsThatOfTheSurfaceAndNotOfTheBackground) {
    // Right of column 160 lies a still background, where nothing was measured.
    const Picture picture = [](int pair, double x, double y) {
        return x < 160 ? moving(someMotions())(pair, x, y) : texture(1.3 * x, y);
    };
    expectMotions(estimate(drawPairs(picture), surfaceUpTo(152)), someMotions());
}

TEST(ImageMotion, IsThatOfMostOfTheSurface) {
    // A highlight of the light stands still on the moving surface.
    const Picture picture = [](int pair, double x, double y) {
        const bool highlight = std::hypot(x - 60, y - 60) < 15;
        return highlight ? 40 : moving(someMotions())(pair, x, y);
    };
    const Motions motions = estimate(drawPairs(picture), surfaceUpTo());
    for (int pair = 0; pair < 3; ++pair) {
        EXPECT_NEAR(motions[pair].column, someMotions()[pair].column, 0.06);
        EXPECT_NEAR(motions[pair].y, someMotions()[pair].y, 0.06);
    }
}

TEST(ImageMotion, IsZeroWhereTheImageDoesNotTell) {
    const Picture flat = [](int, double, double) { return 80.0; };
    expectMotions(estimate(drawPairs(flat), surfaceUpTo()), {});
    const VertexGrid nothing = makeGrid(16, kWidth, [](int, int) { return std::nan(""); });
    expectMotions(estimate(drawPairs(moving(someMotions())), nothing), {});
}

}  // namespace
}  // namespace facescan
