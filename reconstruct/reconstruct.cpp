#include "reconstruct/reconstruct.h"

#include "reconstruct/border.h"
#include "reconstruct/edge_bias.h"
#include "reconstruct/normals.h"
#include "reconstruct/quality.h"
#include "reconstruct/smooth.h"
#include "reconstruct/surface_motion.h"

namespace facescan {
namespace {

/// Finds how the face moved, and moves every edge to where it would have been seen at the reference
/// moment. @returns the number of cells emptied
int moveToReferenceMoment(const SurfaceMiddle& middle, int bits, Workspace& work,
                          StageFindings& findings) {
    findReferencePlanes(work.calibration, work.grid, work.points, work.reference_planes);
    const MeasuredSurface surface{work.calibration, work.grid, work.points, work.reference_planes};
    findings.image_motions =
        estimateImageMotion(work.intake.halves(), work.grid, middle.place, work.image_motion);
    findings.motion = estimateSurfaceMotion(surface, work.calibration, bits, middle,
                                            findings.image_motions, work.motion);
    return compensateMotion(surface, findings.motion, bits, work.grid);
}

}  // namespace

void reconstruct(const FrameStackView& frames, const ScanDescription& scan, const Options& options,
                 Workspace& workspace, Reconstruction& result, StageObserver* observer) {
    IncrementalReconstruction(frames, scan, options, workspace).finish(result, observer);
}

IncrementalReconstruction::IncrementalReconstruction(const FrameStackView& frames,
                                                     const ScanDescription& scan,
                                                     const Options& options, Workspace& workspace)
    : frames_(frames), scan_(scan), options_(options), work_(workspace) {
    work_.intake.begin(frames, scan, options.compensate_motion);
    work_.calibration.prepare(scan, work_.intake.images().width, options.recover_device);
}

void IncrementalReconstruction::take(int index) {
    const int pattern_frame = index - scan_.first_frame;
    if (pattern_frame >= 0 && pattern_frame < scan_.pattern.frameCount()) {
        work_.intake.take(pattern_frame);
    }
}

void IncrementalReconstruction::finish(Reconstruction& result, StageObserver* observer) {
    const ScanDescription& scan = scan_;
    const Options& options = options_;
    Workspace& work = work_;
    const auto finished = [&](Stage stage) {
        if (observer) observer->finished(stage);
    };
    Report& report = result.report;
    report = {};

    work.intake.turnRest();
    const StripeImages& images = work.intake.images();
    finished(Stage::preprocess);

    work.intake.addRest();
    const PixelPlanes& planes = work.intake.planes();
    const DecodeCounts decoded = decodeEdges(images, planes, work.calibration.placesInRange(),
                                             options, work.decode, work.grid);
    report.edges_found = decoded.found;
    report.edges_decoded = decoded.decoded;
    finished(Stage::decode);

    makeTexture(frames_, scan, options.gamma, work.texture, result.texture);
    finished(Stage::texture);

    StageFindings findings;
    report.vertices_rejected =
        decoded.out_of_range + rejectFalseEdges(options, decoded.rising, work.filter, work.grid);
    findings.stripe_width_px = medianStripeWidth(work.grid, work.values);
    calibrateCells(work.calibration, work.grid, work.points);
    const int beyond = rejectOutOfRange(scan.calibration, work.points, work.row_flags, work.grid);
    report.vertices_rejected += beyond;
    findings.out_of_range = decoded.out_of_range + beyond;
    const SurfaceMiddle middle = findMiddle(work.grid, work.points);
    findings.mm_per_px = millimetresPerPixel(work.calibration, middle);
    finished(Stage::filter);

    if (options.compensate_motion) {
        report.vertices_rejected += moveToReferenceMoment(middle, images.bits, work, findings);
    }
    const PairDrift drift = driftWithinPairs(scan.pattern, findings.image_motions);
    correctEdgeBias(options.lens_blur_px, drift, images.bits, work.row_flags, work.grid);
    finished(Stage::motion);

    findings.noise = estimateNoise(work.grid, work.values);
    if (options.smooth) {
        report.vertices_rejected += smoothEdges(options, findings.noise, work.smooth, work.grid);
    }
    finished(Stage::smooth);

    calibrateCells(work.calibration, work.grid, work.points);
    report.vertices_rejected +=
        rejectOutOfRange(scan.calibration, work.points, work.row_flags, work.grid);
    finished(Stage::calibrate);

    if (options.fill_holes) {
        const FillCounts holes = fillHoles(options, work.points, work.fill, work.grid);
        report.holes_found = holes.found;
        report.holes_filled = holes.filled;
        calibrateFilledCells(work.calibration, work.grid, work.points);
        const SeenStripes seen{work.calibration, planes, findings.image_motions, images.bits,
                               decoded.rising};
        carryToBorder(options, seen, work.border, work.grid, work.points);
        rejectOutOfRange(scan.calibration, work.points, work.row_flags, work.grid);
    }
    finished(Stage::fill);

    tessellate(options, work.grid, work.points, decoded.rising, work.tessellate, work.quads);
    finished(Stage::tessellate);

    const float side = turnsClockwise(scan.pattern, decoded.rising) ? -1.0f : 1.0f;
    computeNormals(work.grid, work.points, work.quads, side, work.normal, work.normals);
    finished(Stage::normals);

    layMesh(scan, work.grid, work.points, work.normals, work.quads, decoded.rising, findings.noise,
            work.lay_mesh, result.mesh);
    finished(Stage::mesh);

    assessQuality(scan, planes, work.grid, findings, work.quality, result.mesh, report);
    finished(Stage::quality);
}

}  // namespace facescan
