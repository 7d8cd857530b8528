#include "bench/kernels/kernel_subject.h"

namespace facescan::bench {
namespace {

constexpr int kCells = kRowLength;

KernelCall referencePlanes(KernelRows& rows) {
    constexpr int kReach = 4;
    const ReferenceRows around{.above = rows.points(0, 50),
                               .below = rows.points(0, 50),
                               .here = rows.points(0, 2),
                               .ahead = rows.points(0, 2),
                               .reach = kReach,
                               .least_mm_per_px = 0.15f,
                               .above_y = rows.floats(100, 102),
                               .below_y = rows.floats(104, 106),
                               .beyond_above_y = rows.floats(96, 98),
                               .beyond_below_y = rows.floats(108, 110),
                               .beyond_above = rows.flags(),
                               .beyond_below = rows.flags(),
                               .largest_jump = 1.5f,
                               .largest_bend = 1};
    const ReferencePlaneRow planes{rows.points(0, 0), rows.room<float>(), rows.flags()};
    return [=](const Kernels& kernel) { kernel.referencePlanes(around, kCells, planes); };
}

KernelCall compensateRow(KernelRows& rows) {
    const PointRow points = rows.points(0, 50);
    const ConstReferencePlaneRow planes{rows.points(-1, 1), rows.floats(0.2f, 1), rows.flags()};
    const MotionAbout motion{{10, 20, 30}, {0.1f, -0.2f, 0.3f}, {0.01f, 0.02f, -0.01f}};
    float* shift = rows.room<float>();
    return
        [=](const Kernels& kernel) { kernel.compensateRow(points, planes, motion, kCells, shift); };
}

KernelCall correctBias(KernelRows& rows) {
    const EdgeLightRow row{rows.flags(), rows.floats(100, 106), rows.floats(-1, 1),
                           rows.floats(-1, 1), rows.floats(-2, 2)};
    float* corrected = rows.room<float>();
    return [=](const Kernels& kernel) {
        kernel.correctBias(row, {0.25f, 0.1f, -0.2f}, kCells, corrected);
    };
}

KernelCall sumAlignment(KernelRows& rows) {
    AlignmentBatch batch{.row = {}, .distance = rows.floats(-1, 1), .count = kCells};
    for (const float*& row : batch.row) row = rows.floats(-50, 50);
    return [batch](const Kernels& kernel) {
        SixSums sums;
        kernel.sumAlignment(batch, {1e-3f, 2e-3f, -1e-3f, 1e-4f, 0, 2e-4f}, 0.7f, sums);
    };
}

RegistrationPixels registrationPixels(KernelRows& rows) {
    return {kCells,
            rows.floats(0, 1),
            rows.floats(-0.1f, 0.1f),
            rows.floats(-0.1f, 0.1f),
            rows.floats(-100, 100),
            rows.floats(-100, 100)};
}

/// Results of warpPixels(); levels as they are looked up for them.
WarpedPixels warpedPixels(KernelRows& rows) {
    WarpedPixels warped{rows.room<std::int32_t>(), rows.room<std::int32_t>(), rows.floats(0, 1),
                        rows.floats(0, 1),         rows.floats(1, 1),         {}};
    for (std::int32_t*& level : warped.level) level = rows.integers<std::int32_t>(0, 30000);
    return warped;
}

KernelCall warpPixels(KernelRows& rows) {
    const RegistrationPixels pixels = registrationPixels(rows);
    const WarpedPixels warped{rows.room<std::int32_t>(), rows.room<std::int32_t>(),
                              rows.room<float>(),        rows.room<float>(),
                              rows.room<float>(),        {}};
    const Similarity motion{1.3f, -0.7f, 0.01f, 0.02f, 120, 190, 238, 382};
    return [=](const Kernels& kernel) { kernel.warpPixels(pixels, motion, warped); };
}

KernelCall sumRegistration(KernelRows& rows) {
    const RegistrationPixels pixels = registrationPixels(rows);
    const WarpedPixels warped = warpedPixels(rows);
    return [=](const Kernels& kernel) {
        SixSums sums;
        kernel.sumRegistration(pixels, warped, {1e-4f, 1.1f, 0.01f, 1.0f / 64, 0.8f}, sums);
    };
}

/// Items are the pixels of the halved row.
KernelCall halveRows(KernelRows& rows) {
    std::array<const std::uint8_t*, 4> full;
    for (const std::uint8_t*& row : full) row = rows.integers<std::uint8_t>(0, 255, 2);
    auto* halved = rows.room<std::uint16_t>();
    return [=](const Kernels& kernel) { kernel.halveRows(full, kCells, halved); };
}

KernelCall blurRows(KernelRows& rows) {
    std::array<const std::uint16_t*, 3> sharp;
    for (const std::uint16_t*& row : sharp) row = rows.integers<std::uint16_t>(0, 2040);
    auto* blurred = rows.room<std::uint16_t>();
    return [=](const Kernels& kernel) { kernel.blurRows(sharp, kCells, blurred); };
}

constexpr KernelSubject kSubjects[] = {{"referencePlanes", kCells, referencePlanes},
                                       {"compensateRow", kCells, compensateRow},
                                       {"correctBias", kCells, correctBias},
                                       {"sumAlignment", kCells, sumAlignment},
                                       {"warpPixels", kCells, warpPixels},
                                       {"sumRegistration", kCells, sumRegistration},
                                       {"halveRows", kCells, halveRows},
                                       {"blurRows", kCells, blurRows}};

}  // namespace

std::span<const KernelSubject> motionKernels() {
    return kSubjects;
}

}  // namespace facescan::bench
