#include <algorithm>

#include "bench/kernels/kernel_subject.h"

// A full batch of edges, and the cells that they are laid into.

namespace facescan::bench {
namespace {

constexpr int kEdges = EdgeBatch::kSize;
constexpr int kFrames = 16;
constexpr double kGatheredBytes = 14 * sizeof(std::int32_t);  // of an edge in the batch
constexpr double kResultBytes = 5 * sizeof(float);

template <typename Row>
void fill(const Row* from, EdgeBatch::Column<Row>& column) {
    std::copy_n(from, kEdges, column.begin());
}

/// What gatherEdges() leaves of edges that all run the same way.
EdgeBatch gathered() {
    KernelRows rows(kEdges);
    EdgeBatch batch{};
    batch.count = kEdges;
    for (int r = 0; r < 4; ++r) {
        fill(r < 2 ? rows.integers<std::int32_t>(-400, 0) : rows.integers<std::int32_t>(1, 400),
             batch.difference[r]);
        fill(rows.integers<std::int32_t>(400, 2000), batch.sum[r]);
        fill(rows.integers<std::int32_t>(4000, 16000), batch.brightness[r]);
    }
    fill(rows.integers<std::int32_t>(2000, 8000), batch.brightness_left);
    fill(rows.integers<std::int32_t>(2000, 8000), batch.brightness_right);
    fill(rows.integers<std::uint8_t>(1, 1), batch.inside);
    fill(rows.floats(0, 700), batch.row);
    return batch;
}

KernelCall gatherEdges(KernelRows& rows) {
    constexpr int kRows = 4;
    const std::ptrdiff_t stride = rows.stride();
    const std::array<std::ptrdiff_t, kRows> offsets{0, stride, 2 * stride, 3 * stride};
    const EdgeRun first_run{rows.integers<std::uint8_t>(0, 255, kRows),
                            rows.integers<std::uint8_t>(0, 255, kRows),
                            offsets,
                            rows.integers<std::uint16_t>(0, 4000, kRows),
                            offsets,
                            -1,
                            1};
    rows.count(kEdges * kGatheredBytes);
    EdgeBatch* batch = rows.keep(EdgeBatch{});
    return [=](const Kernels& kernel) {
        EdgeRun run = first_run;
        for (int first = 0; first < kEdges; first += EdgeRun::kMost) {
            kernel.gatherEdges(run, first, *batch);
            run.pattern += EdgeRun::kMost;
            run.complement += EdgeRun::kMost;
            run.brightness += EdgeRun::kMost;
        }
    };
}

KernelCall locateEdges(KernelRows& rows) {
    rows.count(kEdges * (kGatheredBytes + sizeof(std::uint8_t) + sizeof(float) + kResultBytes));
    EdgeBatch* batch = rows.keep(gathered());
    return [batch](const Kernels& kernel) { kernel.locateEdges(*batch, kFrames); };
}

/// Into cells of which all are measured, half of them with more contrast.
KernelCall layEdges(KernelRows& rows) {
    EdgeBatch made = gathered();
    made.contrast.fill(20);
    const EdgeBatch* batch = rows.keep(made);
    rows.count(kEdges * kResultBytes);
    const EdgeCells row{rows.integers<std::uint8_t>(1, 1),
                        rows.floats(0, 700),
                        rows.floats(0, 40),
                        rows.floats(-1, 1),
                        rows.floats(-1, 1),
                        rows.floats(-1, 1)};
    return [=](const Kernels& kernel) {
        for (int at = 0; at < kEdges; at += EdgeRun::kMost) {
            kernel.layEdges(*batch, at, EdgeRun::kMost,
                            {row.measured + at, row.y + at, row.contrast + at, row.gradient_x + at,
                             row.gradient_y + at, row.drift_gain + at});
        }
    };
}

constexpr KernelSubject kSubjects[] = {{"gatherEdges", kEdges, gatherEdges},
                                       {"locateEdges", kEdges, locateEdges},
                                       {"layEdges", kEdges, layEdges}};

}  // namespace

std::span<const KernelSubject> edgeKernels() {
    return kSubjects;
}

}  // namespace facescan::bench
