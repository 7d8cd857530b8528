#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bench/scans.h"
#include "bench/work.h"

// How fast one core reads: the floor under every benchmark that goes through frames.

namespace facescan::bench {
namespace {

using Word = std::uint64_t;
using Frames = std::vector<Word>;

constexpr std::size_t kLanes = 32;

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#endif
Word combine(const Word* words, std::size_t count) {
    Word lanes[kLanes] = {};
    for (std::size_t at = 0; at + kLanes <= count; at += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] ^= words[at + lane];
    }
    Word all = 0;
    for (const Word lane : lanes) all ^= lane;
    return all;
}

/// So many scans that a cache keeps none until its turn comes again; at most 64, since a virtual
/// machine may claim a cache that one core never sees.
std::size_t copiesBeyondTheCaches(std::size_t scan_bytes) {
    std::size_t largest = std::size_t(16) << 20;
    for (const auto& cache : benchmark::CPUInfo::Get().caches)
        largest = std::max(largest, std::size_t(cache.size));
    return std::clamp<std::size_t>(4 * largest / scan_bytes, 2, 64);
}

/// Streams the frames of one scan after another.
void streams(benchmark::State& state, const std::vector<Frames>& copies) {
    std::size_t copy = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(combine(copies[copy].data(), copies[copy].size()));
        copy = (copy + 1) % copies.size();
    }
    const FrameStackView frames = faceScan().frames.view();
    const double pixels = double(frames.width) * frames.height;
    report({pixels * frames.count, pixels, double(frames.count)}, state);
}

std::size_t wordsOfAScan() {
    return faceScan().frames.pixels.size() / sizeof(Word);
}

void streamsFromCache(benchmark::State& state) {
    streams(state, {Frames(wordsOfAScan(), 1)});
}

void streamsFromMemory(benchmark::State& state) {
    const std::size_t words = wordsOfAScan();
    streams(state,
            std::vector<Frames>(copiesBeyondTheCaches(words * sizeof(Word)), Frames(words, 1)));
}

BENCHMARK(streamsFromMemory)->Name("bandwidth/memory");
BENCHMARK(streamsFromCache)->Name("bandwidth/cache");

}  // namespace
}  // namespace facescan::bench
