#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>

#include "capture/bundle.h"
#include "capture/samples.h"
#include "capture/scan_xml.h"

namespace facescan {
namespace {

using namespace test;
namespace gen = rc::gen;

/// Any finite double, all bit patterns alike: huge, tiny, subnormal and negative zero too.
double anyDouble() {
    const auto isFinite = [](std::uint64_t bits) {
        return std::isfinite(std::bit_cast<double>(bits));
    };
    return std::bit_cast<double>(*gen::suchThat(gen::arbitrary<std::uint64_t>(), isFinite));
}

double anyDoubleButZero() {
    const double value = anyDouble();
    return value == 0 ? 1 : value;
}

int between(int min, int max) {
    return *gen::inRange(min, max + 1);
}

FrameStack anyFrames(int least_count) {
    const int width = between(16, 40);
    return makeFrames(between(least_count, least_count + 5), width, between(16, 40),
                      between(width, width + 9), *gen::arbitrary<unsigned>());
}

Rect anyPartOf(const FrameStack& frames) {
    const int width = between(16, frames.width);
    const int height = between(16, frames.height);
    return {between(0, frames.width - width), between(0, frames.height - height), width, height};
}

Pattern anyPattern() {
    return {between(4, 12), CodeAxis(between(0, 1)), FrameOrder(between(0, 1))};
}

Calibration anyCalibration() {
    Calibration calibration;
    calibration.degree = between(1, 5);
    for (NormalisedInput* input : {&calibration.x, &calibration.y, &calibration.code})
        *input = {anyDouble(), anyDoubleButZero()};
    for (std::vector<double>& output : calibration.coefficients)
        for (int n = 0; n < polynomialTerms(calibration.degree); ++n) output.push_back(anyDouble());
    const double a = anyDouble();
    const double b = anyDouble();
    RC_PRE(a != b);
    calibration.range_min_mm = std::min(a, b);
    calibration.range_max_mm = std::max(a, b);
    return calibration;
}

TEST(ScanXmlProperty, WhatIsFormattedParsesToTheSame) {
    EXPECT_TRUE(rc::check([] {
        ScanDescription scan;
        scan.first_frame = between(0, 1024);
        scan.image = {between(0, 8176), between(0, 8176), between(16, 8192), between(16, 8192)};
        scan.pattern = anyPattern();
        scan.calibration = anyCalibration();
        expectSame(parseScanXml(formatScanXml(scan), "scan.xml").description, scan);
        RC_ASSERT(!testing::Test::HasFailure());
    }));
}

TEST(BundleProperty, WhatIsWrittenIsReadBackTheSame) {
    const TempFolder folder;
    EXPECT_TRUE(rc::check([&] {
        ScanDescription scan;
        scan.pattern = anyPattern();
        const FrameStack frames = anyFrames(scan.pattern.frameCount());
        scan.first_frame = between(0, frames.count - scan.pattern.frameCount());
        scan.image = anyPartOf(frames);
        scan.calibration = anyCalibration();
        const CaptureTiming timing{*gen::arbitrary<std::uint64_t>(),
                                   *gen::arbitrary<std::uint64_t>()};

        std::filesystem::remove_all(folder / "scan");
        writeBundle(folder / "scan", scan, frames.view(), timing);
        const ScanBundle read = readBundle(folder / "scan");

        expectSame(read.description, scan);
        expectSame(read.frames, frames);
        RC_ASSERT(read.timing == timing);
        RC_ASSERT(!testing::Test::HasFailure());
    }));
}

}  // namespace
}  // namespace facescan
