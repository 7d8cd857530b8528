#include <benchmark/benchmark.h>

#include "bench/laps.h"
#include "bench/scans.h"
#include "bench/work.h"
#include "reconstruct/reconstruct.h"

namespace facescan::bench {
namespace {

enum Step : std::size_t { kEarlierFrames, kLastFrame };

/// A scan of which one frame arrives after the other: what is done before the last one is there,
/// and what a user waits for from then on.
void reconstructsAsFramesArrive(benchmark::State& state, const ScanBundle& (*scan_of)()) {
    const ScanBundle& scan = scan_of();
    const FrameStackView frames = scan.frames.view();
    const int first = scan.description.first_frame;
    const int last = first + scan.description.pattern.frameCount() - 1;
    const Options options;
    Workspace workspace;
    Reconstruction result;
    reconstruct(frames, scan.description, options, workspace, result);
    if (result.mesh.triangles.empty()) return state.SkipWithError("no surface was reconstructed");

    Laps laps({"before the last frame", "last frame to mesh"});
    for (auto _ : state) {
        laps.begin();
        IncrementalReconstruction scanned(frames, scan.description, options, workspace);
        for (int index = first; index < last; ++index) scanned.take(index);
        laps.finished(kEarlierFrames);
        scanned.take(last);
        scanned.finish(result);
        laps.finished(kLastFrame);
        laps.end();
    }
    laps.report(state);
    report(workOf(scan.description), state);
}

BENCHMARK_CAPTURE(reconstructsAsFramesArrive, face, faceScan)->Name("incremental/face");
BENCHMARK_CAPTURE(reconstructsAsFramesArrive, small, smallScan)->Name("incremental/small");

}  // namespace
}  // namespace facescan::bench
