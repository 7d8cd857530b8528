#include "bench/kernels/kernel_subject.h"
#include "reconstruct/window_fit.h"

namespace facescan::bench {
namespace {

constexpr int kCells = kRowLength;
constexpr int kWindow = 1;  // into kWindows: the one in the middle
constexpr const Window& kShape = kWindows[kWindow];
constexpr int kCodes = 2 * kShape.half_codes + 1;

KernelCall markRegular(KernelRows& rows) {
    const RegularityRows around{rows.floats(96, 97), rows.floats(100, 101), rows.floats(104, 105),
                                rows.floats(1, 60)};
    auto* regular = rows.flags();
    return [=](const Kernels& kernel) {
        kernel.markRegular(around, {0.3f, 8}, 0, kCells, regular);
    };
}

KernelCall keepCommon(KernelRows& rows) {
    std::array<const std::uint8_t*, kCodes> flags;
    for (const std::uint8_t*& row : flags) row = rows.flags();
    auto* common = rows.room<std::uint8_t>();
    return [=](const Kernels& kernel) { kernel.keepCommon(flags.data(), kCodes, kCells, common); };
}

KernelCall keepSurrounded(KernelRows& rows) {
    const auto* flags = rows.flags();
    auto* common = rows.room<std::uint8_t>();
    return [=](const Kernels& kernel) {
        kernel.keepSurrounded(flags, kShape.half_columns, 0, kCells, common);
    };
}

KernelCall filterRow(KernelRows& rows) {
    const float* y = rows.floats(100, 101, kCodes) + kShape.half_codes * rows.stride();
    const FilteredRow row{y,
                          int(rows.stride()),
                          rows.flags(),
                          {rows.room<float>(), rows.room<float>()},
                          rows.room<float>()};
    return [=](const Kernels& kernel) { kernel.filterRow(row, fixedFilter(kWindow), 0, kCells); };
}

/// Beside an outline: a tenth of the cells are missing, a few stand out.
KernelCall fitWindows(KernelRows& rows) {
    const std::ptrdiff_t middle = kShape.half_codes * rows.stride();
    float* y = rows.floats(-0.1f, 0.1f, kCodes);
    float* present = rows.floats(1, 1, kCodes);
    for (std::ptrdiff_t i = 0; i < kCodes * rows.stride() - KernelRows::kMargin; ++i) {
        const std::ptrdiff_t code = i / rows.stride();
        y[i] += 50 + 4 * float(code) + (i % 29 == 0 ? 3.0f : 0.0f);
        if (i % 11 == 0) y[i] = present[i] = 0;
    }
    FitSpan span;
    span.y = y + middle;
    span.present = present + middle;
    span.stride = rows.stride();
    span.setWindow(kShape);
    span.fewest = 8;
    span.cutoff.fill(0.4f);
    span.wanted.fill(1);
    FitSpan* kept = rows.keep(span);
    return [=](const Kernels& kernel) { kernel.fitWindows(*kept); };
}

constexpr KernelSubject kSubjects[] = {{"markRegular", kCells, markRegular},
                                       {"keepCommon", kCells, keepCommon},
                                       {"keepSurrounded", kCells, keepSurrounded},
                                       {"filterRow", kCells, filterRow},
                                       {"fitWindows", FitSpan::kSize, fitWindows}};

}  // namespace

std::span<const KernelSubject> windowKernels() {
    return kSubjects;
}

}  // namespace facescan::bench
