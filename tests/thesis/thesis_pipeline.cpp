#include "thesis/thesis_pipeline.h"

#include "thesis/decode.h"
#include "thesis/delaunay.h"
#include "thesis/fill_holes.h"
#include "thesis/frame_shift.h"
#include "thesis/polynomial.h"
#include "thesis/preprocess.h"
#include "thesis/stripe_images.h"
#include "thesis/texture.h"
#include "thesis/to_mesh.h"

namespace facescan::thesis {

namespace {

void shiftFrames(const std::vector<int>& shifts, std::vector<FramePair>& pairs) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        pairs[k] = {movedDown(pairs[k].pattern, shifts[k]),
                    movedDown(pairs[k].complement, shifts[k])};
    }
}

std::vector<Transition> decode(const std::vector<FramePair>& pairs, double min_modulation) {
    std::vector<Image> stripes;
    stripes.reserve(pairs.size());
    for (const FramePair& pair : pairs) stripes.push_back(normalised(pair));
    return transitions(decodePixels(stripes, modulation(pairs), min_modulation));
}

std::vector<Triangle> tessellate(const std::vector<SurfaceVertex>& vertices) {
    std::vector<PlanePoint> points;
    points.reserve(vertices.size());
    for (const SurfaceVertex& vertex : vertices) points.push_back(vertex.image);
    return delaunay(points);
}

std::vector<SurfaceVertex> calibrate(const std::vector<Transition>& found,
                                     const ScanDescription& scan) {
    std::vector<SurfaceVertex> vertices;
    for (const auto& [place, code] : found) {
        const PlanePoint in_frame = placeInFrame(scan, place);
        vertices.push_back(
            {in_frame, toMillimetres(scan.calibration, in_frame, code), int(place.x)});
    }
    return vertices;
}

}  // namespace

Result reconstruct(const FrameStackView& frames, const ScanDescription& scan,
                   const Options& options) {
    Result result;
    std::vector<FramePair> pairs = preprocess(frames, scan);
    result.texture = texture(pairs.back(), options.gamma);

    layStripesAlongRows(scan.pattern.axis, pairs);
    if (options.shift_frames) {
        result.shifts_px = shiftsToFinestPair(pairs, options.max_shift_px);
        shiftFrames(result.shifts_px, pairs);
    }

    Surface surface;
    surface.vertices = calibrate(decode(pairs, options.min_modulation), scan);
    surface.faces = tessellate(surface.vertices);

    dropLonely(options.line, surface);
    dropBorder(scan.image, options.border_px, surface);
    dropOutOfRange(scan.calibration.range_min_mm, scan.calibration.range_max_mm, surface);
    dropLongFaces(options.max_edge_ratio, surface);
    fillHoles(surface);
    dropLongFaces(options.max_edge_ratio, surface);
    dropUnusedVertices(surface);
    result.mesh = toMesh(surface, scan.image);
    return result;
}

}  // namespace facescan::thesis
