#include "render/texture_fit.h"

#include <gtest/gtest.h>

#include "render/meshes.h"

namespace facescan {
namespace {

TEST(TextureFit, LeavesAFittingTextureAsItIs) {
    const GreyImage image{3, 2, {1, 2, 3, 4, 5, 6}};
    EXPECT_EQ(fitTexture(image, 3).pixels, image.pixels);
}

TEST(TextureFit, HalvesATextureOneColumnTooWide) {
    const GreyImage fitted = fitTexture(testing::quarters(0, 0, 0, 0, 2049, 10), 2048);
    EXPECT_EQ(fitted.width, 1025);
    EXPECT_EQ(fitted.height, 5);
    EXPECT_EQ(fitted.pixels.size(), 1025u * 5u);
}

TEST(TextureFit, APixelIsTheMeanOfItsSquare) {
    const GreyImage image{4,
                          2,
                          {10, 20, 0, 0,  //
                           30, 40, 0, 255}};
    EXPECT_EQ(fitTexture(image, 2).pixels, (std::vector<std::uint8_t>{25, 64}));
}

TEST(TextureFit, ABorderPixelIsTheMeanOfWhatLiesInside) {
    const GreyImage image{3,
                          3,
                          {0, 0, 7,  //
                           0, 0, 9,  //
                           3, 5, 200}};
    EXPECT_EQ(fitTexture(image, 2).pixels, (std::vector<std::uint8_t>{0, 8, 4, 200}));
}

TEST(TextureFit, AnEmptyTextureStaysEmpty) {
    EXPECT_TRUE(fitTexture({}, 2048).pixels.empty());
}

}  // namespace
}  // namespace facescan
