#include "reconstruct/pixel_planes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reconstruct/random_frames.h"
#include "reconstruct/stripe_image_planes.h"

namespace facescan {
namespace {

using test::fillPlanes;

struct PlaneLayout {
    int width;
    int height;
    int row_stride;
    int first_byte;  ///< of the first row, so that rows begin off any alignment
};

StripeImages imagesIn(const FrameStack& frames, int bits, const PlaneLayout& layout) {
    StripeImages images;
    images.bits = bits;
    images.width = layout.width;
    images.height = layout.height;
    images.row_stride = frames.row_stride;
    for (int pair = 0; pair < bits; ++pair) {
        images.pattern[pair] = frames.view().frame(2 * pair) + layout.first_byte;
        images.complement[pair] = frames.view().frame(2 * pair + 1) + layout.first_byte;
    }
    return images;
}

int differenceAt(const StripeImages& images, int pair, int x, int y) {
    x = std::clamp(x, 0, images.width - 1);
    return images.patternRow(pair, y)[x] - images.complementRow(pair, y)[x];
}

/// Whether pattern − complement is positive, averaged along the stripe with weights 1 2 1.
bool signAt(const StripeImages& images, int pair, int x, int y) {
    return differenceAt(images, pair, x - 1, y) + 2 * differenceAt(images, pair, x, y) +
               differenceAt(images, pair, x + 1, y) >
           0;
}

void expectPlanes(const StripeImages& images, const PixelPlanes& planes) {
    ASSERT_EQ(planes.width, images.width);
    ASSERT_EQ(planes.height, images.height);
    for (int y = 0; y < images.height; ++y) {
        for (int x = 0; x < images.width; ++x) {
            std::uint32_t codeword = 0;
            int low = 255, high = 0, sum = 0;
            for (int pair = 0; pair < images.bits; ++pair) {
                codeword = 2 * codeword + std::uint32_t(signAt(images, pair, x, y));
                for (const int level :
                     {images.patternRow(pair, y)[x], images.complementRow(pair, y)[x]}) {
                    low = std::min(low, level);
                    high = std::max(high, level);
                    sum += level;
                }
            }
            const std::size_t i = planes.index(x, y);
            ASSERT_EQ(planes.stripe[i], grayStripe(codeword)) << "at " << x << ", " << y;
            ASSERT_EQ(planes.modulation[i], high - low) << "at " << x << ", " << y;
            ASSERT_EQ(planes.brightness[i], sum) << "at " << x << ", " << y;
        }
    }
}

class PixelPlanesOfWidth : public testing::TestWithParam<int> {};

TEST_P(PixelPlanesOfWidth, AgreeWithALoopOverPixels) {
    const int width = GetParam();
    for (const int bits : {4, 8, 12}) {
        for (const int first_byte : {0, 1, 7}) {
            const PlaneLayout layout{width, 19, width + first_byte + 3, first_byte};
            const FrameStack frames = test::randomFrames(
                2 * bits, width + first_byte, layout.height, layout.row_stride, width * 31 + bits);
            const StripeImages images = imagesIn(frames, bits, layout);
            PixelPlanes planes;
            fillPlanes(images, planes);
            expectPlanes(images, planes);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Widths, PixelPlanesOfWidth,
                         testing::Values(16, 17, 31, 32, 33, 63, 64, 65, 127, 129, 480));

TEST(PixelPlanes, AreOverwrittenByTheNextScan) {
    PixelPlanes planes;
    for (const int width : {64, 17, 80}) {
        const PlaneLayout layout{width, 16, width, 0};
        const FrameStack frames = test::randomFrames(16, width, 16, width, width);
        const StripeImages images = imagesIn(frames, 8, layout);
        fillPlanes(images, planes);
        expectPlanes(images, planes);
    }
}

TEST(PixelPlanes, HoldTheSumOfTwelvePairsOfWhiteFrames) {
    FrameStack frames = test::randomFrames(24, 16, 16, 16, 1);
    std::fill(frames.pixels.begin(), frames.pixels.end(), std::uint8_t(255));
    PixelPlanes planes;
    fillPlanes(imagesIn(frames, 12, {16, 16, 16, 0}), planes);
    EXPECT_EQ(planes.brightness.front(), 24 * 255);
    EXPECT_EQ(planes.modulation.front(), 0);
    EXPECT_EQ(planes.stripe.front(), 0) << "equal pixels are not lit";
}

}  // namespace
}  // namespace facescan
