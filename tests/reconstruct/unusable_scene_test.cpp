#include <gtest/gtest.h>

#include <algorithm>

#include "reconstruct/allocations.h"
#include "reconstruct/mesh_topology.h"
#include "reconstruct/pinhole_scanner.h"
#include "reconstruct/random_frames.h"
#include "reconstruct/reconstruct.h"

namespace facescan {
namespace {

using namespace test;

Reconstruction run(const FrameStack& frames, const ScanDescription& scan) {
    Workspace workspace;
    Reconstruction result;
    reconstruct(frames.view(), scan, {}, workspace, result);
    return result;
}

/// A description for frames of any size: of the small scanner, its polynomial not fitted to them.
ScanDescription describe(const FrameStack& frames, CodeAxis axis = CodeAxis::y, int bits = 8) {
    ScanDescription scan = PinholeScanner{.axis = axis}.describe(FrameOrder::interleaved, 300, 520);
    scan.pattern.bits = bits;
    scan.image = {0, 0, frames.width, frames.height};
    return scan;
}

FrameStack greyFrames(int level) {
    FrameStack frames = randomFrames(16, 200, 240, 200, 1);
    std::fill(frames.pixels.begin(), frames.pixels.end(), std::uint8_t(level));
    return frames;
}

void expectNoSurface(const Reconstruction& result, Reason reason) {
    EXPECT_TRUE(result.mesh.vertices.empty());
    EXPECT_TRUE(result.mesh.triangles.empty());
    EXPECT_EQ(result.report.verdict, Verdict::repeat);
    EXPECT_EQ(result.report.reason, reason) << describe(Verdict::repeat, result.report.reason);
    EXPECT_EQ(result.report.triangles, 0);
    EXPECT_EQ(result.report.vertices_measured, 0);
    EXPECT_EQ(result.report.coverage, 0);
}

TEST(UnusableScene, AllBlackIsDark) {
    expectNoSurface(run(greyFrames(0), describe(greyFrames(0))), Reason::dark);
}

TEST(UnusableScene, AllGreyIsDark) {
    expectNoSurface(run(greyFrames(90), describe(greyFrames(90))), Reason::dark);
}

TEST(UnusableScene, AllWhiteIsOverExposed) {
    expectNoSurface(run(greyFrames(255), describe(greyFrames(255))), Reason::over_exposed);
}

TEST(UnusableScene, SensorNoiseInTheDarkIsDark) {
    FrameStack frames = greyFrames(3);
    addNoise(1.2, 2, frames);
    expectNoSurface(run(frames, describe(frames)), Reason::dark);
}

TEST(UnusableScene, NoiseHasNoPattern) {
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        const FrameStack frames = randomFrames(16, 200, 240, 200, seed);
        expectNoSurface(run(frames, describe(frames)), Reason::no_pattern);
    }
}

TEST(UnusableScene, NoiseOfFewBitsHasNoPattern) {
    // With few stripes, chance names more of them.
    const FrameStack frames = randomFrames(8, 200, 240, 200, 7);
    expectNoSurface(run(frames, describe(frames, CodeAxis::y, 4)), Reason::no_pattern);
}

TEST(UnusableScene, FlickeringLightHasNoPattern) {
    FrameStack frames = greyFrames(0);
    for (int frame = 0; frame < frames.count; ++frame) {
        std::fill_n(frames.pixels.begin() + std::ptrdiff_t(frames.view().frameBytes()) * frame,
                    frames.view().frameBytes(), std::uint8_t(60 + 7 * (frame * 5 % 16)));
    }
    expectNoSurface(run(frames, describe(frames)), Reason::no_pattern);
}

TEST(UnusableScene, ASurfaceOutOfRangeHasNoMesh) {
    const PinholeScanner scanner;
    ScanDescription scan = scanner.describe(FrameOrder::interleaved, 340, 480);
    const FrameStack frames = drawScan(sceneOf(scanner, planeSurface(400, 0, 0)), scan.pattern,
                                       scanner.width, scanner.height);
    scan.calibration.range_min_mm = 450;
    const Reconstruction result = run(frames, scan);
    EXPECT_TRUE(result.mesh.triangles.empty());
    EXPECT_EQ(result.report.verdict, Verdict::repeat);
}

TEST(UnusableScene, ASmallSurfaceIsSaidToBeSmall) {
    const PinholeScanner scanner;
    const ScanDescription scan = scanner.describe(FrameOrder::interleaved, 340, 480);
    StripedScene scene = sceneOf(scanner, planeSurface(400, 0, 0));
    const Field code = scene.code;
    scene.code = [code](double x, double y) {
        return x > 60 && x < 90 && y > 80 && y < 120 ? code(x, y) : std::nan("");
    };
    const FrameStack frames = drawScan(scene, scan.pattern, scanner.width, scanner.height);
    const Reconstruction result = run(frames, scan);
    EXPECT_EQ(result.report.reason, Reason::too_little_surface);
    EXPECT_NE(result.report.verdict, Verdict::good);
}

TEST(UnusableScene, FaintStripesAreSaidToBeFaint) {
    const PinholeScanner scanner;
    const ScanDescription scan = scanner.describe(FrameOrder::interleaved, 340, 480);
    StripedScene scene = sceneOf(scanner, planeSurface(400, 0, 0));
    scene.white_level = 14;
    scene.ambient_level = 60;
    const FrameStack frames = drawScan(scene, scan.pattern, scanner.width, scanner.height);
    const Reconstruction result = run(frames, scan);
    EXPECT_NE(result.report.verdict, Verdict::good);
    EXPECT_TRUE(result.report.reason == Reason::low_contrast ||
                result.report.reason == Reason::noisy)
        << describe(result.report.verdict, result.report.reason);
    EXPECT_NEAR(result.report.modulation_median, 14, 2);
}

TEST(UnusableScene, ManySaturatedPixelsAreSaidToBeOverExposed) {
    const PinholeScanner scanner;
    const ScanDescription scan = scanner.describe(FrameOrder::interleaved, 340, 480);
    StripedScene scene = sceneOf(scanner, planeSurface(400, 0, 0));
    scene.white_level = 600;
    scene.ambient_level = 100;
    const FrameStack frames = drawScan(scene, scan.pattern, scanner.width, scanner.height);
    const Reconstruction result = run(frames, scan);
    EXPECT_NE(result.report.verdict, Verdict::good);
    EXPECT_EQ(result.report.reason, Reason::over_exposed);
}

struct Size {
    int width;
    int height;
};

class ImageOfSize : public testing::TestWithParam<Size> {};

TEST_P(ImageOfSize, IsReconstructedWithoutAFault) {
    const auto [width, height] = GetParam();
    for (const CodeAxis axis : {CodeAxis::x, CodeAxis::y}) {
        const FrameStack noise = randomFrames(16, width, height, width, 3);
        expectNoSurface(run(noise, describe(noise, axis)), Reason::no_pattern);

        const StripedScene scene{.code = [=](double x, double y) {
            return 40.3 + 0.25 * (axis == CodeAxis::x ? x : y);
        }};
        const Pattern pattern{.bits = 8, .axis = axis};
        const FrameStack stripes = drawScan(scene, pattern, width, height);
        const Reconstruction result = run(stripes, describe(stripes, axis));
        MeshFlaws flaws = findFlaws(result.mesh);
        flaws.seen_from_behind = 0;  // the calibration is not meant for these images
        EXPECT_EQ(flaws, MeshFlaws{});
        EXPECT_EQ(result.texture.pixels.size(), std::size_t(width) * height);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ImageOfSize,
                         testing::Values(Size{16, 16}, Size{17, 16}, Size{16, 19}, Size{8192, 16},
                                         Size{16, 8192}));

TEST(Memory, IsBoundedByTheSizeOfTheFrames) {
    // The widest image, the fewest rows, the most stripes: few of these can be seen.
    const FrameStack frames = randomFrames(24, 8192, 16, 8192, 4);
    const ScanDescription scan = describe(frames, CodeAxis::y, 12);
    Workspace workspace;
    Reconstruction result;
    const long before = allocations().bytes;
    reconstruct(frames.view(), scan, {}, workspace, result);
    const long taken = allocations().bytes - before;
    EXPECT_LT(taken, 100 * long(frames.pixels.size()));
}

}  // namespace
}  // namespace facescan
