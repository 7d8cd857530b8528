#include "reconstruct/reconstruct.h"

#include <benchmark/benchmark.h>

#include "bench/laps.h"
#include "bench/scans.h"
#include "bench/work.h"

namespace facescan::bench {
namespace {

/// From frames in memory to mesh, texture and report, in one thread, after a first time that takes
/// the memory.
void reconstructs(benchmark::State& state, const ScanBundle& (*scan_of)()) {
    const ScanBundle& scan = scan_of();
    const FrameStackView frames = scan.frames.view();
    const Options options;
    Workspace workspace;
    Reconstruction result;
    reconstruct(frames, scan.description, options, workspace, result);
    if (result.mesh.triangles.empty()) return state.SkipWithError("no surface was reconstructed");

    StageClock clock;
    for (auto _ : state) {
        clock.begin();
        reconstruct(frames, scan.description, options, workspace, result, &clock);
        clock.end();
    }
    clock.report(state);
    report(workOf(scan.description), state);
}

BENCHMARK_CAPTURE(reconstructs, face, faceScan)->Name("reconstruct/face");
BENCHMARK_CAPTURE(reconstructs, small, smallScan)->Name("reconstruct/small");
BENCHMARK_CAPTURE(reconstructs, large, largeScan)->Name("reconstruct/large");

}  // namespace
}  // namespace facescan::bench
