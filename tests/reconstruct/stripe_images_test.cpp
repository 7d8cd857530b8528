#include "reconstruct/stripe_images.h"

#include <gtest/gtest.h>

#include "reconstruct/random_frames.h"
#include "reconstruct/stripe_image_planes.h"

namespace facescan {
namespace {

using test::allStripeImages;
using test::randomFrames;

constexpr Rect kCrop{5, 3, 41, 37};

ScanDescription describe(CodeAxis axis, FrameOrder order, int first_frame) {
    ScanDescription scan;
    scan.first_frame = first_frame;
    scan.image = kCrop;
    scan.pattern = {6, axis, order};
    return scan;
}

FrameStack someFrames() {
    return randomFrames(2 + 12 + 1, 64, 48, 71, 1);
}

int pixelOf(const FrameStack& frames, int frame, int x, int y) {
    return frames.pixels[(std::size_t(frame) * frames.height + y) * frames.row_stride + x];
}

TEST(StripeImages, AreTheCroppedFramesWhereStripesLieAlongRows) {
    const FrameStack frames = someFrames();
    std::vector<std::uint8_t> buffer;
    const StripeImages images =
        allStripeImages(frames.view(), describe(CodeAxis::y, FrameOrder::interleaved, 0), buffer);
    ASSERT_EQ(images.bits, 6);
    ASSERT_EQ(images.width, kCrop.width);
    ASSERT_EQ(images.height, kCrop.height);
    for (int pair = 0; pair < 6; ++pair) {
        for (int y = 0; y < kCrop.height; ++y) {
            for (int x = 0; x < kCrop.width; ++x) {
                const int frame_x = kCrop.x + x;
                const int frame_y = kCrop.y + y;
                ASSERT_EQ(images.patternRow(pair, y)[x],
                          pixelOf(frames, 2 * pair, frame_x, frame_y));
                ASSERT_EQ(images.complementRow(pair, y)[x],
                          pixelOf(frames, 2 * pair + 1, frame_x, frame_y));
            }
        }
    }
}

TEST(StripeImages, AreNotCopiedWhereStripesLieAlongRows) {
    const FrameStack frames = someFrames();
    std::vector<std::uint8_t> buffer;
    const StripeImages images =
        allStripeImages(frames.view(), describe(CodeAxis::y, FrameOrder::interleaved, 0), buffer);
    EXPECT_TRUE(buffer.empty());
    EXPECT_EQ(images.patternRow(0, 0), &frames.pixels[kCrop.y * frames.row_stride + kCrop.x]);
}

TEST(StripeImages, AreTransposedWhereStripesLieAlongColumns) {
    const FrameStack frames = someFrames();
    std::vector<std::uint8_t> buffer;
    const StripeImages images =
        allStripeImages(frames.view(), describe(CodeAxis::x, FrameOrder::interleaved, 0), buffer);
    ASSERT_EQ(images.width, kCrop.height);
    ASSERT_EQ(images.height, kCrop.width);
    for (int pair = 0; pair < 6; ++pair) {
        for (int y = 0; y < images.height; ++y) {
            for (int x = 0; x < images.width; ++x) {
                const int frame_x = kCrop.x + y;
                const int frame_y = kCrop.y + x;
                ASSERT_EQ(images.patternRow(pair, y)[x],
                          pixelOf(frames, 2 * pair, frame_x, frame_y));
                ASSERT_EQ(images.complementRow(pair, y)[x],
                          pixelOf(frames, 2 * pair + 1, frame_x, frame_y));
            }
        }
    }
}

TEST(StripeImages, FindTheFramesOfAGroupedScanBehindOthers) {
    const FrameStack frames = someFrames();
    for (const CodeAxis axis : {CodeAxis::x, CodeAxis::y}) {
        std::vector<std::uint8_t> buffer;
        const StripeImages images =
            allStripeImages(frames.view(), describe(axis, FrameOrder::grouped, 2), buffer);
        for (int pair = 0; pair < 6; ++pair) {
            EXPECT_EQ(images.patternRow(pair, 0)[0], pixelOf(frames, 2 + pair, kCrop.x, kCrop.y));
            EXPECT_EQ(images.complementRow(pair, 0)[0],
                      pixelOf(frames, 2 + 6 + pair, kCrop.x, kCrop.y));
        }
    }
}

TEST(StripeImages, UseTheBufferOfAnEarlierScanAgain) {
    const FrameStack frames = someFrames();
    std::vector<std::uint8_t> buffer(100000, 7);
    const std::uint8_t* memory = buffer.data();
    allStripeImages(frames.view(), describe(CodeAxis::x, FrameOrder::grouped, 0), buffer);
    EXPECT_EQ(buffer.data(), memory);
}

}  // namespace
}  // namespace facescan
