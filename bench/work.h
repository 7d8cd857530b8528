#pragma once

#include <benchmark/benchmark.h>

#include "reconstruct/scan.h"

namespace facescan::bench {

/// What one iteration of a benchmark goes through. The table makes its rates of it.
struct Work {
    double bytes = 0;   ///< that must be read or written at least once
    double pixels = 0;  ///< of the image, counted once whatever the number of frames
    double frames = 0;  ///< 0 where the work is not on frames
};

/// A whole scan: the pixels that are reconstructed, in all frames that carry a pattern.
Work workOf(const ScanDescription& scan);

/// Adds the work to the results, as the counters `bytes`, `pixels` and `frames`.
void report(const Work& work, benchmark::State& state);

}  // namespace facescan::bench
