#include "bench/work.h"

namespace facescan::bench {

Work workOf(const ScanDescription& scan) {
    const double pixels = double(scan.image.width) * scan.image.height;
    const double frames = scan.pattern.frameCount();
    return {pixels * frames, pixels, frames};
}

void report(const Work& work, benchmark::State& state) {
    state.counters["bytes"] = work.bytes;
    if (work.pixels > 0) state.counters["pixels"] = work.pixels;
    if (work.frames > 0) state.counters["frames"] = work.frames;
}

}  // namespace facescan::bench
