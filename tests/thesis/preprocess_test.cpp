#include "thesis/preprocess.h"

#include <gtest/gtest.h>

namespace facescan::thesis {
namespace {

/// Four-bit patterns of 24 × 20 pixels: an extra frame first, rows padded. Each pixel's value tells
/// its frame, row and column.
FrameStack numberedFrames() {
    FrameStack frames{{}, 9, 24, 20, 25};
    frames.pixels.resize(9 * 20 * 25);
    for (int frame = 0; frame < 9; ++frame) {
        for (int y = 0; y < 20; ++y) {
            for (int x = 0; x < 24; ++x) {
                frames.pixels[(frame * 20 + y) * 25 + x] = std::uint8_t(25 * frame + y + (x == 7));
            }
        }
    }
    return frames;
}

ScanDescription croppedScan(CodeAxis axis, FrameOrder order) {
    ScanDescription scan;
    scan.first_frame = 1;
    scan.image = {5, 3, 17, 16};
    scan.pattern = {4, axis, order};
    return scan;
}

TEST(ThesisPreprocess, CropsScalesAndSortsIntoPairs) {
    const FrameStack frames = numberedFrames();
    const auto pairs = preprocess(frames.view(), croppedScan(CodeAxis::y, FrameOrder::interleaved));
    ASSERT_EQ(pairs.size(), 4u);
    EXPECT_EQ(pairs[2].pattern.width, 17);
    EXPECT_EQ(pairs[2].pattern.height, 16);
    EXPECT_DOUBLE_EQ(pairs[2].pattern.at(0, 0), (25 * 5 + 3) / 255.0);
    EXPECT_DOUBLE_EQ(pairs[2].complement.at(2, 4), (25 * 6 + 7 + 1) / 255.0);
}

TEST(ThesisPreprocess, FindsTheComplementsOfAGroupedScan) {
    const FrameStack frames = numberedFrames();
    const auto pairs = preprocess(frames.view(), croppedScan(CodeAxis::y, FrameOrder::grouped));
    EXPECT_DOUBLE_EQ(pairs[2].pattern.at(0, 0), (25 * 3 + 3) / 255.0);
    EXPECT_DOUBLE_EQ(pairs[2].complement.at(0, 0), (25 * 7 + 3) / 255.0);
}

TEST(ThesisPreprocess, ColumnsOfStripesAreLaidAlongRowsAndFoundAgain) {
    const FrameStack frames = numberedFrames();
    const ScanDescription scan = croppedScan(CodeAxis::x, FrameOrder::interleaved);
    auto pairs = preprocess(frames.view(), scan);
    const double value = pairs[0].pattern.at(2, 9);
    layStripesAlongRows(scan.pattern.axis, pairs);
    EXPECT_EQ(pairs[0].pattern.width, 16);
    EXPECT_EQ(pairs[0].pattern.at(9, 2), value);

    const PlanePoint place = placeInFrame(scan, {9, 2.5});
    EXPECT_EQ(place.x, 5 + 2.5);
    EXPECT_EQ(place.y, 3 + 9);
}

}  // namespace
}  // namespace facescan::thesis
