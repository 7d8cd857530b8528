#include "bench/kernels/kernel_subject.h"

namespace facescan::bench {
namespace {

constexpr int kWidth = kRowLength;
constexpr int kPairs = 8;
constexpr int kPixelsAnEdge = 7;
constexpr int kLeastModulation = 6;

PixelRow pixelRow(KernelRows& rows) {
    return {rows.room<std::uint16_t>(), rows.room<std::uint16_t>(),
            rows.integers<std::uint8_t>(0, 40), rows.integers<std::uint8_t>(100, 255)};
}

KernelCall startRow(KernelRows& rows) {
    return [row = pixelRow(rows)](const Kernels& kernel) { kernel.startRow(kWidth, row); };
}

KernelCall addPairs(KernelRows& rows) {
    PairRows pairs{.count = kPairs};
    for (int pair = 0; pair < kPairs; ++pair) {
        pairs.pattern[pair] = rows.integers<std::uint8_t>(0, 255);
        pairs.complement[pair] = rows.integers<std::uint8_t>(0, 255);
    }
    return [pairs, row = pixelRow(rows)](const Kernels& kernel) {
        kernel.addPairs(pairs, kWidth, row);
    };
}

KernelCall finishRow(KernelRows& rows) {
    return [row = pixelRow(rows)](const Kernels& kernel) { kernel.finishRow(kWidth, row); };
}

KernelCall classifyEdges(KernelRows& rows) {
    const auto* above = rows.integers<std::uint16_t>(127, 127);
    auto* below = rows.integers<std::uint16_t>(127, 127);
    for (int x = 0; x < kWidth; x += kPixelsAnEdge) ++below[x];
    const auto* light_above = rows.integers<std::uint8_t>(0, 100);
    const auto* light_below = rows.integers<std::uint8_t>(0, 100);
    auto* classes = rows.room<std::uint8_t>();
    return [=](const Kernels& kernel) {
        kernel.classifyEdges(above, below, light_above, light_below, kLeastModulation, kWidth,
                             classes);
    };
}

constexpr KernelSubject kSubjects[] = {{"startRow", kWidth, startRow},
                                       {"addPairs", kWidth, addPairs},
                                       {"finishRow", kWidth, finishRow},
                                       {"classifyEdges", kWidth, classifyEdges}};

}  // namespace

std::span<const KernelSubject> pixelKernels() {
    return kSubjects;
}

}  // namespace facescan::bench
