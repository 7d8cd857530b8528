#include "thesis/stripe_images.h"

#include <gmock/gmock.h>

namespace facescan::thesis {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;

Image row(std::vector<double> values) {
    Image image(int(values.size()), 1);
    image.values = std::move(values);
    return image;
}

TEST(ThesisStripeImages, NormalisingRemovesReflectance) {
    const FramePair bright = {row({0.8}), row({0.2})};
    const FramePair dark = {row({0.08}), row({0.02})};
    EXPECT_THAT(normalised(bright).values, ElementsAre(DoubleNear(0.6, 1e-12)));
    EXPECT_THAT(normalised(dark).values, ElementsAre(DoubleNear(0.6, 1e-12)));
}

TEST(ThesisStripeImages, APixelWithoutLightNormalisesToZero) {
    EXPECT_THAT(normalised({row({0.0}), row({0.0})}).values, ElementsAre(0.0));
}

TEST(ThesisStripeImages, ThePatternCannotBeSeenInTheEvenlyLitImage) {
    const FramePair stripes = {row({0.7, 0.1, 0.7, 0.1}), row({0.1, 0.7, 0.1, 0.7})};
    EXPECT_THAT(evenlyLit(stripes).values, Each(DoubleEq(0.8)));
}

TEST(ThesisStripeImages, ModulationIsTheSpanOverAllFrames) {
    const std::vector<FramePair> pairs = {{row({0.3, 0.5}), row({0.4, 0.5})},
                                          {row({0.9, 0.5}), row({0.2, 0.5})}};
    EXPECT_THAT(modulation(pairs).values, ElementsAre(DoubleNear(0.7, 1e-12), 0.0));
}

}  // namespace
}  // namespace facescan::thesis
