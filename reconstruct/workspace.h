#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/calibrate.h"
#include "reconstruct/decode.h"
#include "reconstruct/fill.h"
#include "reconstruct/filter.h"
#include "reconstruct/image_motion.h"
#include "reconstruct/pixel_planes.h"
#include "reconstruct/smooth.h"
#include "reconstruct/surface_motion.h"
#include "reconstruct/tessellate.h"
#include "reconstruct/texture.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Memory of a reconstruction, kept from scan to scan so that only the first one of a size
/// allocates. Holds nothing that a caller needs to know.
struct Workspace {
    std::vector<std::uint8_t> turned_frames;
    PixelPlanes planes;
    std::vector<StripeEdge> edges;
    VertexGrid grid;
    GridCalibration calibration;
    std::vector<Point> points;
    std::vector<float> values;
    std::vector<Point> slopes;
    ImageMotionScratch image_motion;
    std::vector<AlignmentEquation> motion;
    FilterScratch filter;
    SmoothScratch smooth;
    FillScratch fill;
    TessellateScratch tessellate;
    TextureScratch texture;
};

}  // namespace facescan
