#include "reconstruct/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>

#include "reconstruct/allocations.h"
#include "reconstruct/mesh_topology.h"
#include "reconstruct/pinhole_scanner.h"
#include "reconstruct/random_frames.h"

namespace facescan {
namespace {

using namespace test;
using Eigen::Vector3d;

/// Frames and what they mean.
struct Scan {
    FrameStack frames;
    ScanDescription description;
};

Scan scanOf(const PinholeScanner& scanner, const Surface& surface,
            FrameOrder order = FrameOrder::interleaved) {
    Scan scan;
    scan.description = scanner.describe(order, 340, 480);
    scan.frames = drawScan(sceneOf(scanner, surface), scan.description.pattern, scanner.width,
                           scanner.height);
    return scan;
}

const Vector3d kCentre(3, -4, 470);
constexpr double kRadius = 75;

Surface ball() {
    return sphereSurface(kCentre, kRadius);
}

Reconstruction run(const Scan& scan, Workspace& workspace) {
    Reconstruction result;
    reconstruct(scan.frames.view(), scan.description, {}, workspace, result);
    return result;
}

Reconstruction run(const Scan& scan) {
    Workspace workspace;
    return run(scan, workspace);
}

template <typename T>
void expectSameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0);
}

void expectSameResult(const Reconstruction& a, const Reconstruction& b) {
    expectSameBytes(a.mesh.vertices, b.mesh.vertices);
    expectSameBytes(a.mesh.triangles, b.mesh.triangles);
    expectSameBytes(a.texture.pixels, b.texture.pixels);
    EXPECT_EQ(a.report.vertices_measured, b.report.vertices_measured);
    EXPECT_EQ(a.report.noise_mm, b.report.noise_mm);
    EXPECT_EQ(a.report.verdict, b.report.verdict);
}

struct Device {
    CodeAxis axis;
    bool rising;
    FrameOrder order;
};

class ReconstructOn : public testing::TestWithParam<Device> {};

TEST_P(ReconstructOn, ASphereIsASphere) {
    const PinholeScanner scanner{.axis = GetParam().axis, .rising = GetParam().rising};
    const Scan scan = scanOf(scanner, ball(), GetParam().order);
    const Reconstruction result = run(scan);
    EXPECT_GT(result.mesh.vertices.size(), 6000u);
    EXPECT_EQ(findFlaws(result.mesh), MeshFlaws{});
    double squares = 0;
    for (const Vertex& v : result.mesh.vertices) {
        const Vector3d place(v.x, v.y, v.z);
        const Vector3d radius = place - kCentre;
        EXPECT_NEAR(radius.norm(), kRadius, 0.2);
        EXPECT_GT(radius.normalized().dot(Vector3d(v.nx, v.ny, v.nz)), std::cos(0.15));
        squares += std::pow(radius.norm() - kRadius, 2);

        const Eigen::Vector2d seen = scanner.project(place);
        EXPECT_NEAR(v.s, (seen.x() + 0.5) / scanner.width, 2e-4);
        EXPECT_NEAR(v.t, 1 - (seen.y() + 0.5) / scanner.height, 2e-4);
    }
    EXPECT_LT(std::sqrt(squares / double(result.mesh.vertices.size())), 0.03);
    EXPECT_EQ(result.report.vertices_measured + result.report.vertices_filled,
              int(result.mesh.vertices.size()));
    EXPECT_EQ(result.report.triangles, int(result.mesh.triangles.size()));
    EXPECT_EQ(result.report.verdict, Verdict::good) << int(result.report.reason);
    EXPECT_GT(result.report.coverage, 0.9);
    EXPECT_LT(result.report.motion_max_mm, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Devices, ReconstructOn,
                         testing::Values(Device{CodeAxis::y, true, FrameOrder::interleaved},
                                         Device{CodeAxis::y, false, FrameOrder::grouped},
                                         Device{CodeAxis::x, true, FrameOrder::grouped},
                                         Device{CodeAxis::x, false, FrameOrder::interleaved}));

TEST(Reconstruct, MeasuresATiltedPlane) {
    const Scan scan = scanOf({}, planeSurface(400, 0.25, -0.15));
    const Vector3d normal = Vector3d(0.25, -0.15, -1).normalized();
    const Reconstruction result = run(scan);
    EXPECT_GT(result.mesh.vertices.size(), 5000u);
    for (const Vertex& v : result.mesh.vertices) {
        EXPECT_NEAR(normal.dot(Vector3d(v.x, v.y, v.z - 400)), 0, 0.15);
        if (v.quality == 0) continue;  // carried to the image's border
        EXPECT_GT(normal.dot(Vector3d(v.nx, v.ny, v.nz)), std::cos(0.15));
    }
}

TEST(Reconstruct, DoesWithAnyNumberOfBits) {
    for (const int bits : {4, 6, 12}) {
        // The stripes are as wide for all; few bits make a narrow projector.
        const PinholeScanner scanner{.bits = bits};
        const Reconstruction result = run(scanOf(scanner, planeSurface(400, 0, 0)));
        const double shown = std::min(1 << bits, int(scanner.height / 3.6));
        EXPECT_GT(double(result.mesh.vertices.size()), 0.7 * shown * scanner.width) << bits;
        for (const Vertex& v : result.mesh.vertices) EXPECT_NEAR(v.z, 400, 0.3);
    }
}

TEST(Reconstruct, GivesTheSameBytesEveryTime) {
    const Scan first = scanOf({}, ball());
    const Scan second =
        scanOf({.axis = CodeAxis::x, .width = 120, .height = 150}, planeSurface(410, 0.1, 0.2));
    const Reconstruction expected = run(first);
    const Reconstruction expected_second = run(second);
    Workspace workspace;
    expectSameResult(run(first, workspace), expected);
    expectSameResult(run(first, workspace), expected);
    expectSameResult(run(second, workspace), expected_second);
    expectSameResult(run(first, workspace), expected);
}

TEST(Reconstruct, OverwritesTheResultOfTheScanBefore) {
    const Scan large = scanOf({}, ball());
    const Scan small = scanOf({.width = 100, .height = 120}, planeSurface(400, 0, 0));
    Workspace workspace;
    Reconstruction result;
    reconstruct(large.frames.view(), large.description, {}, workspace, result);
    reconstruct(small.frames.view(), small.description, {}, workspace, result);
    expectSameResult(result, run(small));
}

TEST(Reconstruct, AllocatesNothingAfterTheFirstScan) {
    for (const CodeAxis axis : {CodeAxis::x, CodeAxis::y}) {
        const Scan scan = scanOf({.axis = axis}, ball());
        Workspace workspace;
        Reconstruction result;
        reconstruct(scan.frames.view(), scan.description, {}, workspace, result);
        const long before = allocations().blocks;
        reconstruct(scan.frames.view(), scan.description, {}, workspace, result);
        EXPECT_EQ(allocations().blocks, before);
    }
}

/// Reconstructs while frames are copied to their places in this order.
Reconstruction runAsTheyArrive(const Scan& scan, const std::vector<int>& order, std::size_t taken,
                               Workspace& workspace) {
    FrameStack arriving = scan.frames;
    std::fill(arriving.pixels.begin(), arriving.pixels.end(), std::uint8_t(0x5A));
    IncrementalReconstruction incremental(arriving.view(), scan.description, {}, workspace);
    const std::size_t bytes = arriving.view().frameBytes();
    for (std::size_t n = 0; n < order.size(); ++n) {
        std::copy_n(scan.frames.view().frame(order[n]), bytes,
                    arriving.pixels.begin() + std::ptrdiff_t(bytes) * order[n]);
        if (n < taken) incremental.take(order[n]);
    }
    Reconstruction result;
    incremental.finish(result);
    return result;
}

TEST(IncrementalReconstruction, GivesTheSameBytesAsAllFramesAtOnce) {
    for (const CodeAxis axis : {CodeAxis::x, CodeAxis::y}) {
        for (const FrameOrder frame_order : {FrameOrder::interleaved, FrameOrder::grouped}) {
            const Scan scan = scanOf({.axis = axis}, ball(), frame_order);
            const Reconstruction expected = run(scan);
            std::vector<int> order(scan.frames.count);
            std::iota(order.begin(), order.end(), 0);
            Workspace workspace;
            expectSameResult(runAsTheyArrive(scan, order, order.size(), workspace), expected);
            std::reverse(order.begin(), order.end());
            expectSameResult(runAsTheyArrive(scan, order, order.size(), workspace), expected);
            std::shuffle(order.begin(), order.end(), std::mt19937(3));
            expectSameResult(runAsTheyArrive(scan, order, order.size(), workspace), expected);
            // Frames that were never announced count all the same.
            expectSameResult(runAsTheyArrive(scan, order, 5, workspace), expected);
        }
    }
}

TEST(IncrementalReconstruction, DoesNotMindFramesWithoutPatternOrTakenTwice) {
    Scan scan = scanOf({}, ball());
    const Reconstruction expected = run(scan);
    // Two frames before the pattern, one behind it.
    const std::size_t bytes = scan.frames.view().frameBytes();
    scan.frames.pixels.insert(scan.frames.pixels.begin(), 2 * bytes, std::uint8_t(77));
    scan.frames.pixels.insert(scan.frames.pixels.end(), bytes, std::uint8_t(200));
    scan.frames.count += 3;
    scan.description.first_frame = 2;
    std::vector<int> order{0, 1, 2, 2, 3, 18};
    for (int frame = 2; frame < 18; ++frame) order.push_back(frame);
    Workspace workspace;
    expectSameResult(runAsTheyArrive(scan, order, order.size(), workspace), expected);
}

TEST(IncrementalReconstruction, AllocatesNothingAfterTheFirstScan) {
    const Scan scan = scanOf({.axis = CodeAxis::x}, ball());
    Workspace workspace;
    Reconstruction result;
    const auto reconstructOnce = [&] {
        IncrementalReconstruction incremental(scan.frames.view(), scan.description, {}, workspace);
        for (int frame = 0; frame < scan.frames.count; ++frame) incremental.take(frame);
        incremental.finish(result);
    };
    reconstructOnce();
    const long before = allocations().blocks;
    reconstructOnce();
    EXPECT_EQ(allocations().blocks, before);
}

TEST(Reconstruct, UsesOnlyItsPartOfTheFrames) {
    const Scan scan = scanOf({}, ball());
    const FrameStackView inner = scan.frames.view();
    // The same frames inside larger, padded ones of noise, behind two others and before a third.
    Scan buried;
    buried.frames =
        randomFrames(2 + inner.count + 1, inner.width + 30, inner.height + 20, inner.width + 41, 1);
    buried.description = scan.description;
    buried.description.first_frame = 2;
    buried.description.image = {13, 9, inner.width, inner.height};
    buried.description.calibration.x.offset += 13;
    buried.description.calibration.y.offset += 9;
    for (int frame = 0; frame < inner.count; ++frame) {
        for (int y = 0; y < inner.height; ++y) {
            const std::size_t row = buried.frames.view().frameBytes() * std::size_t(frame + 2) +
                                    std::size_t(y + 9) * buried.frames.row_stride + 13;
            std::copy_n(inner.frame(frame) + std::size_t(y) * inner.row_stride, inner.width,
                        buried.frames.pixels.data() + row);
        }
    }
    expectSameResult(run(buried), run(scan));
}

TEST(Reconstruct, DiscardsWhatLiesOutsideTheMeasurementRange) {
    Scan scan = scanOf({}, ball());
    scan.description.calibration.range_max_mm = 405;
    const Reconstruction result = run(scan);
    EXPECT_GT(result.mesh.vertices.size(), 1000u);
    EXPECT_GT(result.report.vertices_rejected, 1000);
    for (const Vertex& v : result.mesh.vertices) EXPECT_LE(v.z, 405);
}

TEST(Reconstruct, FillsAndMarksAHoleInside) {
    PinholeScanner scanner;
    StripedScene scene = sceneOf(scanner, ball());
    scene.log_reflectance = [](double x, double y) {
        return std::hypot(x - 80, y - 100) < 3 ? -6.0 : 0.0;  // a black spot
    };
    Scan scan;
    scan.description = scanner.describe(FrameOrder::interleaved, 340, 480);
    scan.frames = drawScan(scene, scan.description.pattern, scanner.width, scanner.height);
    const Reconstruction result = run(scan);
    EXPECT_GE(result.report.holes_found, 1);
    EXPECT_GE(result.report.holes_filled, 1);
    EXPECT_GT(result.report.vertices_filled, 10);
    for (const Vertex& v : result.mesh.vertices) {
        if (v.quality > 0) continue;
        const Eigen::Vector2d seen = scanner.project({v.x, v.y, v.z});
        const bool at_border = seen.y() < 1 || seen.y() > scanner.height - 2;
        if (at_border) continue;
        EXPECT_LT((seen - Eigen::Vector2d(80, 100)).norm(), 12);
        EXPECT_NEAR((Vector3d(v.x, v.y, v.z) - kCentre).norm(), kRadius, 0.5);
    }
    Options options;
    options.fill_holes = false;
    Workspace workspace;
    Reconstruction open;
    reconstruct(scan.frames.view(), scan.description, options, workspace, open);
    EXPECT_EQ(open.report.vertices_filled, 0);
}

class StageList : public StageObserver {
public:
    void finished(Stage stage) override { stages.push_back(stage); }
    std::vector<Stage> stages;
};

std::vector<Stage> stagesToldOf(const Scan& scan) {
    Workspace workspace;
    Reconstruction result;
    StageList list;
    reconstruct(scan.frames.view(), scan.description, {}, workspace, result, &list);
    return list.stages;
}

std::vector<Stage> allStages() {
    std::vector<Stage> all;
    for (int stage = 0; stage < kStageCount; ++stage) all.push_back(Stage(stage));
    return all;
}

TEST(Reconstruct, TellsOfEveryStageOnce) {
    std::vector<Stage> stages = stagesToldOf(scanOf({}, ball()));
    std::sort(stages.begin(), stages.end());
    EXPECT_EQ(stages, allStages());
}

TEST(Reconstruct, TellsOfTheStagesInTheirOrder) {
    EXPECT_EQ(stagesToldOf(scanOf({}, ball())), allStages());
}

TEST(Reconstruct, TellsOfEveryStageWithoutASurfaceToo) {
    Scan scan = scanOf({.width = 40, .height = 40}, planeSurface(400, 0, 0));
    std::fill(scan.frames.pixels.begin(), scan.frames.pixels.end(), std::uint8_t(0));
    EXPECT_EQ(stagesToldOf(scan).size(), std::size_t(kStageCount));
}

TEST(Reconstruct, LeavesTheFramesAlone) {
    const Scan scan = scanOf({.axis = CodeAxis::x}, ball());
    const std::vector<std::uint8_t> before = scan.frames.pixels;
    run(scan);
    EXPECT_EQ(scan.frames.pixels, before);
}

}  // namespace
}  // namespace facescan
