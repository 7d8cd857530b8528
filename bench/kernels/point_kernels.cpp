#include "bench/kernels/kernel_subject.h"

// Cells of one row: their links, their points and what is known of each by itself.

namespace facescan::bench {
namespace {

constexpr int kCells = kRowLength;
constexpr float kNoise = 4;  // grey levels

RowLinks links(KernelRows& rows) {
    return {{rows.flags(), rows.flags(), rows.flags()}, rows.flags()};
}

KernelCall linkNeighbours(KernelRows& rows) {
    const LinkedRows linked{rows.floats(100, 102), rows.floats(104, 106), rows.flags(),
                            rows.flags()};
    return [linked, out = links(rows)](const Kernels& kernel) {
        kernel.linkNeighbours(linked, {2, 2, 8, 1}, 0, kCells, out);
    };
}

KernelCall rejectUnsupported(KernelRows& rows) {
    const RowLinks linked = links(rows);
    const auto* from_before = rows.flags();
    const auto* measured = rows.flags();
    auto* kept = rows.room<std::uint8_t>();
    return [=](const Kernels& kernel) {
        kernel.rejectUnsupported(linked, from_before, measured, 0, kCells, kept);
    };
}

EdgeRow edgeRow(KernelRows& rows) {
    return {rows.floats(-1, 1), rows.floats(0, 700), 0.5f, 380, 1.0f / 380};
}

KernelCall deviceRow(KernelRows& rows) {
    const DeviceRow device{{0.21f, 0.001f, -0.002f}, {0.002f, 0.33f, 0.01f},   {-0.08f, 0.03f, 0},
                           {1e-3f, -5e-4f},          {0.001f, 0.009f, 0.002f}, 1.1f};
    const EdgeRow row = edgeRow(rows);
    const PointRow points = rows.points(0, 0);
    return [=](const Kernels& kernel) { kernel.deviceRow(device, row, kCells, points); };
}

KernelCall polynomialRow(KernelRows& rows) {
    constexpr int kDegree = 5;
    constexpr int kTerms = 21;
    const PolynomialRow polynomial{kDegree, 0.3f, rows.floats(-30, 30, 3 * kTerms), rows.stride(),
                                   kTerms * rows.stride()};
    const EdgeRow row = edgeRow(rows);
    const PointRow points = rows.points(0, 0);
    return [=](const Kernels& kernel) { kernel.polynomialRow(polynomial, row, kCells, points); };
}

KernelCall markInRange(KernelRows& rows) {
    const float* z = rows.floats(290, 530);
    auto* inside = rows.room<std::uint8_t>();
    return [=](const Kernels& kernel) { kernel.markInRange(z, 300, 520, kCells, inside); };
}

KernelCall measureWidths(KernelRows& rows) {
    const float* y = rows.floats(100, 102);
    const float* next = rows.floats(103, 106);
    const auto* both = rows.flags();
    auto* widths = rows.room<std::int32_t>();
    return [=](const Kernels& kernel) { kernel.measureWidths(y, next, both, 8, kCells, widths); };
}

KernelCall vertexQuality(KernelRows& rows) {
    const float* contrast = rows.floats(1, 80);
    float* quality = rows.room<float>();
    return [=](const Kernels& kernel) { kernel.vertexQuality(contrast, kNoise, kCells, quality); };
}

KernelCall chooseWindows(KernelRows& rows) {
    const float* contrast = rows.floats(1, 80);
    auto* window = rows.room<std::uint8_t>();
    return [=](const Kernels& kernel) { kernel.chooseWindows(contrast, kNoise, kCells, window); };
}

constexpr KernelSubject kSubjects[] = {
    {"linkNeighbours", kCells, linkNeighbours}, {"rejectUnsupported", kCells, rejectUnsupported},
    {"deviceRow", kCells, deviceRow},           {"polynomialRow", kCells, polynomialRow},
    {"markInRange", kCells, markInRange},       {"measureWidths", kCells, measureWidths},
    {"vertexQuality", kCells, vertexQuality},   {"chooseWindows", kCells, chooseWindows}};

}  // namespace

std::span<const KernelSubject> pointKernels() {
    return kSubjects;
}

}  // namespace facescan::bench
