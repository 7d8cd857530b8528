#include "reconstruct/reconstruct.h"

#include "reconstruct/border.h"
#include "reconstruct/edge_bias.h"
#include "reconstruct/normals.h"
#include "reconstruct/quality.h"
#include "reconstruct/smooth.h"
#include "reconstruct/surface_motion.h"

namespace facescan {

void reconstruct(const FrameStackView& frames, const ScanDescription& scan, const Options& options,
                 Workspace& work, Reconstruction& result, StageObserver* observer) {
    const auto finished = [&](Stage stage) {
        if (observer) observer->finished(stage);
    };
    Report& report = result.report;
    report = {};

    const StripeImages images = stripeImages(frames, scan, work.turned_frames);
    finished(Stage::preprocess);

    computePixelPlanes(images, work.planes);
    const DecodeCounts decoded = decodeEdges(images, work.planes, options, work.decode, work.grid);
    report.edges_found = decoded.found;
    report.edges_decoded = decoded.decoded;
    finished(Stage::decode);

    makeTexture(frames, scan, options.gamma, work.texture, result.texture);
    finished(Stage::texture);

    StageFindings findings;
    report.vertices_rejected = rejectFalseEdges(options, decoded.rising, work.filter, work.grid);
    findings.stripe_width_px = medianStripeWidth(work.grid, work.values);
    work.calibration.prepare(scan, work.grid.columns, options.recover_device);
    calibrateCells(work.calibration, work.grid, work.points);
    findings.out_of_range = rejectOutOfRange(scan.calibration, work.points, work.grid);
    report.vertices_rejected += findings.out_of_range;
    const SurfaceMiddle middle = findMiddle(work.grid, work.points);
    findings.mm_per_px = millimetresPerPixel(work.calibration, middle);
    finished(Stage::filter);

    if (options.compensate_motion) {
        findReferencePlanes(work.calibration, work.grid, work.points, work.reference_planes);
        const MeasuredSurface surface{work.calibration, work.grid, work.points,
                                      work.reference_planes};
        findings.image_motions =
            estimateImageMotion(images, work.grid, middle.place, work.image_motion);
        findings.motion = estimateSurfaceMotion(surface, work.calibration, images.bits, middle,
                                                findings.image_motions, work.motion);
        report.vertices_rejected +=
            compensateMotion(surface, findings.motion, images.bits, work.grid);
    }
    const PairDrift drift = driftWithinPairs(scan.pattern, findings.image_motions);
    correctEdgeBias(options.lens_blur_px, drift, images.bits, work.grid);
    finished(Stage::motion);

    findings.noise = estimateNoise(work.grid, work.values);
    if (options.smooth) {
        report.vertices_rejected += smoothEdges(options, findings.noise, work.smooth, work.grid);
    }
    finished(Stage::smooth);

    calibrateCells(work.calibration, work.grid, work.points);
    report.vertices_rejected += rejectOutOfRange(scan.calibration, work.points, work.grid);
    finished(Stage::calibrate);

    if (options.fill_holes) {
        const FillCounts holes = fillHoles(options, work.points, work.fill, work.grid);
        report.holes_found = holes.found;
        report.holes_filled = holes.filled;
        calibrateFilledCells(work.calibration, work.grid, work.points);
        carryToBorder(
            options,
            {work.calibration, work.planes, findings.image_motions, images.bits, decoded.rising},
            work.border, work.grid, work.points);
        rejectOutOfRange(scan.calibration, work.points, work.grid);
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

    assessQuality(scan, work.planes, work.grid, findings, work.values, result.mesh, report);
    finished(Stage::quality);
}

}  // namespace facescan
