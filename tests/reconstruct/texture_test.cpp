#include "reconstruct/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reconstruct/random_frames.h"
#include "reconstruct/striped_scene.h"

namespace facescan {
namespace {

using namespace test;

TEST(UnitPower, IsThePowerFunction) {
    for (const double exponent : {0.05, 0.3, 1 / 2.2, 0.5, 0.77, 1.0}) {
        for (int i = 0; i <= 510; ++i) {
            const double x = i / 510.0;
            ASSERT_NEAR(unitPower(x, exponent), std::pow(x, exponent), 1e-6)
                << x << " to the power of " << exponent;
        }
    }
    EXPECT_NEAR(unitPower(1e-9, 0.5), std::pow(1e-9, 0.5), 1e-6);
    EXPECT_EQ(unitPower(0, 0.5), 0);
    EXPECT_EQ(unitPower(1, 0.5), 1);
    EXPECT_EQ(unitPower(0.3, 0), 1);
}

constexpr Pattern kPattern{.bits = 4};

GreyImage textureOf(const FrameStack& frames, const ScanDescription& scan, double gamma) {
    TextureScratch scratch;
    GreyImage texture;
    makeTexture(frames.view(), scan, gamma, scratch, texture);
    return texture;
}

/// Frames whose finest pair has the average `level`(x, y); the others are random.
FrameStack framesOfAverage(int width, int height, const Field& level) {
    FrameStack frames = randomFrames(kPattern.frameCount(), width, height, width, 1);
    const std::size_t bytes = frames.view().frameBytes();
    const int pair = kPattern.finestPair();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int sum = int(std::lround(2 * level(x, y)));
            // The stripes of the pair must not show.
            const int pattern = y % 8 < 4 ? std::min(sum, 255) : std::max(sum - 255, 0);
            const std::size_t pixel = std::size_t(y) * width + x;
            frames.pixels[bytes * kPattern.frameIndex(pair, false) + pixel] = std::uint8_t(pattern);
            frames.pixels[bytes * kPattern.frameIndex(pair, true) + pixel] =
                std::uint8_t(sum - pattern);
        }
    }
    return frames;
}

/// The definition, in floating point: average, gamma, 5 × 5 mean, stretch of the quantiles.
std::vector<double> textureByDefinition(const Field& level, int width, int height, double gamma) {
    const auto corrected = [&](int x, int y) {
        x = std::clamp(x, 0, width - 1);
        y = std::clamp(y, 0, height - 1);
        return std::pow(std::round(2 * level(x, y)) / 510, gamma);
    };
    std::vector<double> mean;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int dy = -2; dy <= 2; ++dy) {
                for (int dx = -2; dx <= 2; ++dx) sum += corrected(x + dx, y + dy);
            }
            mean.push_back(sum / 25);
        }
    }
    std::vector<double> sorted = mean;
    std::sort(sorted.begin(), sorted.end());
    const double low = sorted[std::size_t(0.005 * double(sorted.size()))];
    const double high = sorted[std::size_t(0.995 * double(sorted.size()))];
    for (double& value : mean) value = std::clamp(255 * (value - low) / (high - low), 0.0, 255.0);
    return mean;
}

double wavy(double x, double y) {
    return 120 + 70 * std::sin(0.21 * x) * std::cos(0.17 * y) + 0.2 * x;
}

TEST(Texture, IsTheFilteredAndStretchedAverageOfTheFinestPair) {
    constexpr int kWidth = 97;
    constexpr int kHeight = 83;
    const FrameStack frames = framesOfAverage(kWidth, kHeight, wavy);
    for (const double gamma : {1 / 2.2, 0.7, 1.0}) {
        const GreyImage texture = textureOf(frames, wholeFrames(frames, kPattern), gamma);
        const std::vector<double> expected = textureByDefinition(wavy, kWidth, kHeight, gamma);
        ASSERT_EQ(texture.width, kWidth);
        ASSERT_EQ(texture.height, kHeight);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            ASSERT_NEAR(texture.pixels[i], expected[i], 1.0) << "pixel " << i;
        }
    }
}

TEST(Texture, CoversTheImageRectangleOfTheRightFrames) {
    const FrameStack small = framesOfAverage(40, 30, wavy);
    const GreyImage expected = textureOf(small, wholeFrames(small, kPattern), 0.5);

    // The same picture inside larger, padded frames behind three others.
    FrameStack frames = randomFrames(3 + kPattern.frameCount(), 64, 50, 70, 2);
    ScanDescription scan;
    scan.first_frame = 3;
    scan.pattern = kPattern;
    scan.image = {11, 7, 40, 30};
    for (int frame = 0; frame < kPattern.frameCount(); ++frame) {
        for (int y = 0; y < 30; ++y) {
            std::copy_n(small.view().frame(frame) + std::size_t(y) * 40, 40,
                        frames.pixels.begin() +
                            std::ptrdiff_t(frames.view().frameBytes()) * (3 + frame) +
                            (7 + y) * 70 + 11);
        }
    }
    EXPECT_EQ(textureOf(frames, scan, 0.5).pixels, expected.pixels);
}

TEST(Texture, IsTheSameForGroupedFrames) {
    const FrameStack interleaved = framesOfAverage(40, 30, wavy);
    const Pattern grouped_pattern{.bits = kPattern.bits, .order = FrameOrder::grouped};
    FrameStack grouped = interleaved;
    for (int pair = 0; pair < kPattern.bits; ++pair) {
        for (const bool complement : {false, true}) {
            std::copy_n(interleaved.view().frame(kPattern.frameIndex(pair, complement)),
                        interleaved.view().frameBytes(),
                        grouped.pixels.begin() + std::ptrdiff_t(grouped.view().frameBytes()) *
                                                     grouped_pattern.frameIndex(pair, complement));
        }
    }
    EXPECT_EQ(textureOf(grouped, wholeFrames(grouped, grouped_pattern), 0.5).pixels,
              textureOf(interleaved, wholeFrames(interleaved, kPattern), 0.5).pixels);
}

TEST(Texture, OfAConstantImageIsConstant) {
    for (const double level : {0.0, 90.0, 255.0}) {
        const FrameStack frames = framesOfAverage(32, 24, [=](double, double) { return level; });
        const GreyImage texture = textureOf(frames, wholeFrames(frames, kPattern), 0.5);
        EXPECT_EQ(std::count(texture.pixels.begin(), texture.pixels.end(), texture.pixels[0]),
                  32 * 24);
    }
}

TEST(Texture, OfTheSmallestImageIsStretchedToo) {
    const FrameStack frames = framesOfAverage(16, 16, wavy);
    const GreyImage texture = textureOf(frames, wholeFrames(frames, kPattern), 0.5);
    const auto [low, high] = std::minmax_element(texture.pixels.begin(), texture.pixels.end());
    EXPECT_EQ(*low, 0);
    EXPECT_EQ(*high, 255);
}

}  // namespace
}  // namespace facescan
