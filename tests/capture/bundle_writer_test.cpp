#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <system_error>

#include "capture/bundle.h"
#include "capture/samples.h"

namespace facescan {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using namespace test;
namespace fs = std::filesystem;

TEST(BundleWriter, WritesTheBytesOfTheFormat) {
    const TempFolder folder;
    writeBundle(folder / "scan", sampleDescription(), makeFrames(8, 18, 16, 20).view(),
                {1735689600123456789, 16666667});
    const Bytes expected = sampleFramesFile();
    EXPECT_EQ(readFile(folder / "scan" / "frames.bin"),
              std::string(expected.begin(), expected.end()));
    EXPECT_THAT(namesIn(folder / "scan"), ElementsAre("frames.bin", "scan.xml"));
    expectSame(readBundle(folder / "scan").description, sampleDescription());
}

TEST(BundleWriter, RefusesADescriptionThatTheReaderWouldRefuse) {
    const TempFolder folder;
    const FrameStack frames = makeFrames(8, 18, 16, 20);
    const auto errorOf = [&](auto&& spoil) {
        ScanDescription scan = sampleDescription();
        spoil(scan);
        const BundleError error =
            bundleErrorOf([&] { writeBundle(folder / "scan", scan, frames.view()); });
        EXPECT_EQ(error.file(), (folder / "scan/scan.xml").string());
        return error.field();
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(errorOf([&](auto& s) { s.calibration.coefficients[1][2] = nan; }),
              "output Y number 3");
    EXPECT_EQ(errorOf([&](auto& s) { s.calibration.x.offset = inf; }), "input x offset");
    EXPECT_EQ(errorOf([](auto& s) { s.calibration.code.scale = 0; }), "input code scale");
    EXPECT_EQ(errorOf([](auto& s) { s.calibration.coefficients[0].pop_back(); }), "output X");
    EXPECT_EQ(errorOf([](auto& s) { s.calibration.degree = 6; }), "calibration degree");
    EXPECT_EQ(errorOf([](auto& s) { s.calibration.range_max_mm = 300; }), "range max");
    EXPECT_EQ(errorOf([](auto& s) { s.pattern.bits = 13; }), "pattern bits");
    EXPECT_EQ(errorOf([](auto& s) { s.first_frame = -1; }), "frames first");
    EXPECT_EQ(errorOf([](auto& s) { s.first_frame = 1; }), "frames first + count");
    EXPECT_EQ(errorOf([](auto& s) { s.image.height = 17; }), "image");
    EXPECT_THAT(namesIn(folder.path()), IsEmpty());
}

TEST(BundleWriter, RefusesFramesThatTheReaderWouldRefuse) {
    const TempFolder folder;
    const auto errorOf = [&](int count, int width, int height, int row_stride) {
        const FrameStackView frames{nullptr, count, width, height, row_stride};
        const BundleError error =
            bundleErrorOf([&] { writeBundle(folder / "scan", sampleDescription(), frames); });
        EXPECT_EQ(error.file(), (folder / "scan/frames.bin").string());
        return error.field();
    };
    EXPECT_EQ(errorOf(0, 18, 16, 20), "frame count");
    EXPECT_EQ(errorOf(-1, 18, 16, 20), "frame count");
    EXPECT_EQ(errorOf(8, 15, 16, 20), "width");
    EXPECT_EQ(errorOf(8, 18, 8193, 20), "height");
    EXPECT_EQ(errorOf(8, 18, 16, 17), "row stride");
    EXPECT_THAT(namesIn(folder.path()), IsEmpty());
}

TEST(BundleWriter, LeavesAnEarlierBundleAsItIs) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    EXPECT_THROW(writeBundle(path, sampleDescription(), makeFrames(8, 18, 16, 20, 2).view()),
                 std::system_error);
    expectSame(readBundle(path).frames, makeFrames(8, 18, 16, 20));
}

}  // namespace
}  // namespace facescan
