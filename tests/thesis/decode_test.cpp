#include "thesis/decode.h"

#include <gmock/gmock.h>

#include <numeric>

namespace facescan::thesis {
namespace {

using testing::ElementsAre;

/// The normalised images of a column that shows these stripes of a four-bit code. The codewords are
/// written out, so that they do not come from the code under test.
std::vector<Image> columnOf(const std::vector<int>& stripes) {
    constexpr int kGrey[16] = {0b0000, 0b0001, 0b0011, 0b0010, 0b0110, 0b0111, 0b0101, 0b0100,
                               0b1100, 0b1101, 0b1111, 0b1110, 0b1010, 0b1011, 0b1001, 0b1000};
    std::vector<Image> images(4, Image(1, int(stripes.size())));
    for (int pair = 0; pair < 4; ++pair) {
        for (std::size_t y = 0; y < stripes.size(); ++y) {
            const bool lit = kGrey[stripes[y]] >> (3 - pair) & 1;
            images[pair].at(0, int(y)) = lit ? 0.7 : -0.7;
        }
    }
    return images;
}

Image modulationOf(std::vector<double> values) {
    Image image(1, int(values.size()));
    image.values = std::move(values);
    return image;
}

CodeImage codes(std::vector<int> column) {
    return {1, int(column.size()), std::move(column)};
}

TEST(ThesisDecode, ReadsEveryStripeOfTheGrayCode) {
    std::vector<int> all(16);
    std::iota(all.begin(), all.end(), 0);
    const Image lit = modulationOf(std::vector<double>(16, 0.5));
    EXPECT_EQ(decodePixels(columnOf(all), lit, 0.02).codes, all);
}

TEST(ThesisDecode, APixelWithoutLightHasNoCode) {
    const CodeImage image =
        decodePixels(columnOf({5, 5, 6}), modulationOf({0.5, 0.01, 0.02}), 0.02);
    EXPECT_THAT(image.codes, ElementsAre(5, kNoCode, 6));
}

TEST(ThesisDecode, AVertexLiesBetweenThePixelsOfTwoStripes) {
    const std::vector<Transition> found = transitions(codes({3, 3, 4, 4, 4, 5}));
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].place.y, 1.5);
    EXPECT_EQ(found[0].code, 4);
    EXPECT_EQ(found[1].place.y, 4.5);
    EXPECT_EQ(found[1].code, 5);
}

TEST(ThesisDecode, AFallingCodeNamesTheSameEdges) {
    const std::vector<Transition> found = transitions(codes({5, 5, 4}));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].place.y, 1.5);
    EXPECT_EQ(found[0].code, 5);
}

TEST(ThesisDecode, ALeapOfTheCodeIsNoEdge) {
    EXPECT_TRUE(transitions(codes({3, 7, kNoCode, 8})).empty());
}

}  // namespace
}  // namespace facescan::thesis
