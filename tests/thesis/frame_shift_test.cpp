#include "thesis/frame_shift.h"

#include <gmock/gmock.h>

#include <cmath>

namespace facescan::thesis {
namespace {

using testing::ElementsAre;

/// A profile that is nowhere like itself but in one place.
double bump(double y) {
    return std::exp(-0.01 * (y - 30) * (y - 30)) + 0.5 * std::exp(-0.05 * (y - 52) * (y - 52));
}

std::vector<double> bumpMovedBy(double shift) {
    std::vector<double> rows(80);
    for (int y = 0; y < 80; ++y) rows[y] = bump(y - shift);
    return rows;
}

/// The scene evenly lit, moved down, under a pattern of stripes that stay where they are.
FramePair pairMovedBy(int shift, int stripe_rows) {
    FramePair pair = {Image(6, 80), Image(6, 80)};
    for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 6; ++x) {
            const bool lit = (y / stripe_rows) % 2 == 0;
            pair.pattern.at(x, y) = lit ? 0.4 * bump(y - shift) : 0;
            pair.complement.at(x, y) = lit ? 0 : 0.4 * bump(y - shift);
        }
    }
    return pair;
}

TEST(ThesisFrameShift, AProfileHoldsTheMeanOfEachRow) {
    Image image(2, 3);
    image.values = {1, 3, 0, 0, 5, 6};
    EXPECT_THAT(profile(image), ElementsAre(2, 0, 5.5));
}

TEST(ThesisFrameShift, FindsHowFarAProfileWasShifted) {
    for (int shift = -7; shift <= 7; ++shift) {
        EXPECT_EQ(displacement(bumpMovedBy(0), bumpMovedBy(shift), 8), shift);
    }
}

TEST(ThesisFrameShift, KnowsWholePixelsOnly) {
    EXPECT_EQ(displacement(bumpMovedBy(0), bumpMovedBy(0.4), 8), 0);
    EXPECT_EQ(displacement(bumpMovedBy(0), bumpMovedBy(1.7), 8), 2);
}

TEST(ThesisFrameShift, AProfileWithoutFeaturesStandsStill) {
    const std::vector<double> flat(50, 0.3);
    EXPECT_EQ(displacement(flat, flat, 8), 0);
}

TEST(ThesisFrameShift, AddsUpTheStepsToTheFinestPair) {
    const std::vector<FramePair> pairs = {pairMovedBy(0, 16), pairMovedBy(2, 8), pairMovedBy(3, 4),
                                          pairMovedBy(1, 2)};
    EXPECT_THAT(shiftsToFinestPair(pairs, 8), ElementsAre(1, -1, -2, 0));
}

TEST(ThesisFrameShift, AMovedImageRepeatsItsLastRow) {
    Image image(1, 4);
    image.values = {1, 2, 3, 4};
    EXPECT_THAT(movedDown(image, 1).values, ElementsAre(1, 1, 2, 3));
    EXPECT_THAT(movedDown(image, -2).values, ElementsAre(3, 4, 4, 4));
}

}  // namespace
}  // namespace facescan::thesis
