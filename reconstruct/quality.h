#pragma once

#include <vector>

#include "reconstruct/image_motion.h"
#include "reconstruct/mesh.h"
#include "reconstruct/pixel_planes.h"
#include "reconstruct/report.h"
#include "reconstruct/scan.h"
#include "reconstruct/smooth.h"
#include "reconstruct/surface_motion.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Counts and values that only the stages themselves know.
struct StageFindings {
    int out_of_range = 0;       ///< cells emptied for lying outside the measurement range
    float stripe_width_px = 0;  ///< see medianStripeWidth
    EdgeNoise noise;
    float mm_per_px = 0;  ///< how far a vertex moves along its ray for a pixel of its edge
    SurfaceMotion motion;
    std::array<ImageMotion, kMaxBits> image_motions{};
};

/// Scratch memory of assessQuality.
struct QualityScratch {
    std::vector<float> values;
    // Of one row.
    std::vector<std::uint8_t> covered;
    std::vector<std::int32_t> widths;
};

/// Stage "quality": completes the report, down to the verdict. Where the verdict is that there is
/// no surface, the mesh is emptied: it would be made of chance.
void assessQuality(const ScanDescription& scan, const PixelPlanes& planes, const VertexGrid& grid,
                   const StageFindings& findings, QualityScratch& scratch, Mesh& mesh,
                   Report& report);

}  // namespace facescan
