#include "reconstruct/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "reconstruct/grid_sample.h"
#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/median.h"

namespace facescan {
namespace {

// Limits of the verdict. Shares are of the image's pixels.
constexpr int kLitModulation = 8;         // grey levels: the projector's light reaches the pixel
constexpr double kDarkShare = 0.01;       // less of the image lit than this is no scan
constexpr double kChanceShare = 0.004;    // less surface than this is chance
constexpr double kLittleShare = 0.05;     // less than this is no whole face
constexpr double kSaturatedShare = 0.05;  // more than this costs vertices
constexpr double kWhiteShare = 0.5;
constexpr double kGapsCoverage = 0.8;
constexpr double kLowModulation = 20;  // grey levels, median
constexpr double kNoisyMm = 0.25;      // before smoothing; smoothing leaves about a third
constexpr double kMovedMm = 2.0;       // compensation is proved up to here
constexpr double kLostMm = 6.0;

/// Every row of a small image, some ten thousand pixels or more of a large one.
void measureLight(const PixelPlanes& planes, Report& report) {
    std::array<int, 256> histogram{};
    constexpr int kRows = 128;
    const int step = std::max(planes.height / kRows, 1);
    double pixels = 0;
    for (int y = 0; y < planes.height; y += step) {
        const std::uint8_t* modulation = planes.modulation.data() + planes.index(0, y);
        for (int x = 0; x < planes.width; ++x) ++histogram[modulation[x]];
        pixels += planes.width;
    }
    int lit = 0;
    for (int level = kLitModulation; level < 256; ++level) lit += histogram[level];
    report.lit_share = lit / pixels;
    report.saturated_share = planes.saturated / double(planes.modulation.size());
    int below = 0;
    for (int level = kLitModulation; level < 256 && 2 * below < lit; ++level) {
        below += histogram[level];
        report.modulation_median = level;
    }
}

/// Flags where both cells hold an edge.
FACESCAN_KERNEL void flagPairs(const Cell* __restrict cell, const Cell* __restrict next, int count,
                               std::uint8_t* __restrict flags) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        flags[x] = (cell[x] != Cell::empty) & (next[x] != Cell::empty);
    }
}

/// The pixels between neighbouring stripe edges of one column.
double coveredPixels(const VertexGrid& grid, float stripe_width, QualityScratch& scratch) {
    scratch.covered.resize(grid.columns);
    scratch.widths.resize(grid.columns);
    std::int64_t sum = 0;
    for (int code = 1; code + 1 < grid.codes; ++code) {
        const auto [first, end] = grid.extent[code];
        if (first >= end) continue;
        const std::size_t i = grid.index(code, first);
        const std::size_t next = i + grid.columns;
        const int count = end - first;
        flagPairs(&grid.cell[i], &grid.cell[next], count, scratch.covered.data());
        kernels().measureWidths(&grid.y[i], &grid.y[next], scratch.covered.data(), 4 * stripe_width,
                                count, scratch.widths.data());
        for (int x = 0; x < count; ++x) sum += scratch.widths[x];
    }
    return double(sum) / double(kLengthUnits);
}

float medianContrast(const VertexGrid& grid, std::vector<float>& scratch) {
    scratch.clear();
    forEachSample(grid, 0, [&](std::size_t i) { scratch.push_back(grid.contrast[i]); });
    return medianOf(scratch);
}

void reportMotion(const ScanDescription& scan, const StageFindings& findings, Report& report) {
    const bool turned = scan.pattern.axis == CodeAxis::x;
    for (int pair = 0; pair < scan.pattern.bits; ++pair) {
        const ImageMotion& image = findings.image_motions[pair];
        const auto& t = findings.motion.pairs[pair].translation;
        PairMotion& motion = report.motion[pair];
        motion.dx_px = turned ? image.y : image.column;
        motion.dy_px = turned ? image.column : image.y;
        motion.shift_mm = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
        const double shift_px =
            std::sqrt(double(motion.dx_px) * motion.dx_px + double(motion.dy_px) * motion.dy_px);
        report.motion_max_px = std::max(report.motion_max_px, shift_px);
        report.motion_max_mm = std::max(report.motion_max_mm, double(motion.shift_mm));
    }
}

/// Why there is no surface.
Reason missingSurface(const Report& report) {
    if (report.saturated_share > kWhiteShare) return Reason::over_exposed;
    if (report.lit_share < kDarkShare) return Reason::dark;
    return Reason::no_pattern;
}

/// The most serious flaw of a surface.
Reason worstFlaw(const Report& report, double surface_share) {
    if (surface_share < kLittleShare) return Reason::too_little_surface;
    if (report.motion_max_mm > kMovedMm) return Reason::moved;
    if (report.saturated_share > kSaturatedShare) return Reason::over_exposed;
    if (report.noise_mm > kNoisyMm) return Reason::noisy;
    if (report.modulation_median < kLowModulation) return Reason::low_contrast;
    if (report.coverage < kGapsCoverage) return Reason::gaps;
    return Reason::none;
}

}  // namespace

void assessQuality(const ScanDescription& scan, const PixelPlanes& planes, const VertexGrid& grid,
                   const StageFindings& findings, QualityScratch& scratch, Mesh& mesh,
                   Report& report) {
    measureLight(planes, report);
    reportMotion(scan, findings, report);
    const double pixels = double(planes.modulation.size());
    const double covered = coveredPixels(grid, findings.stripe_width_px, scratch);
    const double beyond = double(findings.out_of_range) * findings.stripe_width_px;
    const double within = report.lit_share * pixels - beyond;
    report.coverage = covered > 0 ? covered / std::max(covered, within) : 0.0;
    report.noise_mm =
        findings.noise.pixels(medianContrast(grid, scratch.values)) * std::fabs(findings.mm_per_px);

    if (covered < kChanceShare * pixels || mesh.triangles.empty()) {
        mesh.vertices.clear();
        mesh.triangles.clear();
        report.coverage = 0;
        report.verdict = Verdict::repeat;
        report.reason = missingSurface(report);
        return;
    }
    report.vertices_filled = int(std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                                               [](const Vertex& v) { return v.quality == 0; }));
    report.vertices_measured = int(mesh.vertices.size()) - report.vertices_filled;
    report.triangles = int(mesh.triangles.size());
    report.reason = worstFlaw(report, covered / pixels);
    report.verdict = report.reason == Reason::none ? Verdict::good
                     : report.motion_max_mm > kLostMm || report.saturated_share > kWhiteShare
                         ? Verdict::repeat
                         : Verdict::usable;
}

}  // namespace facescan
