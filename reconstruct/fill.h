#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/calibrate.h"
#include "reconstruct/options.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

struct FillCounts {
    int found = 0;   ///< holes inside the surface
    int filled = 0;  ///< … that were small enough, and whose rim is one surface
};

/// Scratch memory of fillHoles.
struct FillScratch {
    std::vector<std::uint8_t> visited;
    std::vector<std::uint32_t> region;  ///< the cells of one hole
    std::vector<std::uint32_t> rim;     ///< the measured cells around it
    std::vector<float> residual;        ///< by cell: distance from the fitted surface, px
};

/// Closes the holes of the surface on the vertex grid: connected empty cells that do not reach the
/// outline. The places follow a quadratic surface fitted to the rim, two cells deep, plus the rim's
/// residuals spread over the hole by Laplace's equation, so that the fill meets the rim.
///
/// A hole stays open where its rim is more than options.max_hole_mm across, or where no one surface
/// passes through its rim: there is a real gap behind it, such as between chin and neck.
///
/// @param points  the points of the measured cells
FillCounts fillHoles(const Options& options, const PointPlanes& points, FillScratch& scratch,
                     VertexGrid& grid);

}  // namespace facescan
