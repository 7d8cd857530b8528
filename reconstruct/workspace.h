#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/border.h"
#include "reconstruct/calibrate.h"
#include "reconstruct/decode.h"
#include "reconstruct/fill.h"
#include "reconstruct/filter.h"
#include "reconstruct/frame_intake.h"
#include "reconstruct/image_motion.h"
#include "reconstruct/lay_mesh.h"
#include "reconstruct/normals.h"
#include "reconstruct/quality.h"
#include "reconstruct/smooth.h"
#include "reconstruct/surface_motion.h"
#include "reconstruct/tessellate.h"
#include "reconstruct/texture.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Memory of a reconstruction, kept from scan to scan so that only the first one of a size
/// allocates. Holds nothing that a caller needs to know.
struct Workspace {
    FrameIntake intake;
    DecodeScratch decode;
    VertexGrid grid;
    GridCalibration calibration;
    PointPlanes points;
    std::vector<float> values;
    ReferencePlanes reference_planes;
    ImageMotionScratch image_motion;
    AlignmentEquations motion;
    std::vector<std::uint8_t> row_flags;
    FilterScratch filter;
    SmoothScratch smooth;
    FillScratch fill;
    BorderScratch border;
    TessellateScratch tessellate;
    Quads quads;
    NormalScratch normal;
    PointPlanes normals;
    LayMeshScratch lay_mesh;
    TextureScratch texture;
    QualityScratch quality;
};

}  // namespace facescan
