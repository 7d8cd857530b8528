#include "thesis/texture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace facescan::thesis {
namespace {

TEST(ThesisTexture, TheMeanFilterLeavesAnEvenImageAsItIs) {
    Image image(9, 7);
    std::fill(image.values.begin(), image.values.end(), 0.25);
    EXPECT_THAT(meanFiltered(image, 5).values, testing::Each(testing::DoubleNear(0.25, 1e-12)));
}

TEST(ThesisTexture, TheMeanFilterSpreadsAPointOverFiveByFivePixels) {
    Image image(11, 11);
    image.at(5, 5) = 25;
    const Image mean = meanFiltered(image, 5);
    for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 11; ++x) {
            const bool near = std::max(std::abs(x - 5), std::abs(y - 5)) <= 2;
            EXPECT_NEAR(mean.at(x, y), near ? 1 : 0, 1e-12) << x << ", " << y;
        }
    }
}

TEST(ThesisTexture, AStepIsStretchedToBlackAndWhite) {
    FramePair pair = {Image(40, 8), Image(40, 8)};
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 40; ++x) {
            pair.pattern.at(x, y) = x < 20 ? 0.2 : 0.6;
            pair.complement.at(x, y) = x < 20 ? 0.1 : 0.3;
        }
    }
    const GreyImage image = texture(pair, 1 / 2.2);
    EXPECT_EQ(image.row(4)[10], 0);
    EXPECT_EQ(image.row(4)[30], 255);
}

TEST(ThesisTexture, GammaCorrectionBrightensTheMiddle) {
    FramePair pair = {Image(60, 8), Image(60, 8)};
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 60; ++x) {
            pair.pattern.at(x, y) = pair.complement.at(x, y) = (x / 20) * 0.5;
        }
    }
    // Black, half and full: 0, ½^(1/2) = 0.7071, 1.
    EXPECT_EQ(texture(pair, 0.5).row(4)[30], std::lround(255 * std::sqrt(0.5)));
}

TEST(ThesisTexture, AnImageWithoutContrastIsBlack) {
    EXPECT_THAT(texture({Image(6, 6), Image(6, 6)}, 1).pixels, testing::Each(0));
}

}  // namespace
}  // namespace facescan::thesis
