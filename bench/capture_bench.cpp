#include <benchmark/benchmark.h>

#include "bench/scans.h"
#include "bench/work.h"

namespace facescan::bench {
namespace {

/// A bundle from the page cache, checked, into memory that is used again.
void readsABundle(benchmark::State& state) {
    const std::filesystem::path folder = faceScanFolder();
    ScanBundle bundle;
    for (auto _ : state) {
        readBundle(folder, bundle);
        benchmark::DoNotOptimize(bundle.frames.pixels.data());
    }
    const FrameStackView frames = bundle.frames.view();
    const double pixels = double(frames.width) * frames.height;
    report({pixels * frames.count, pixels, double(frames.count)}, state);
}
BENCHMARK(readsABundle)->Name("capture/read");

}  // namespace
}  // namespace facescan::bench
