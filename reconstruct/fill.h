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

/// Neighbouring empty cells of a row.
struct EmptyRun {
    int code;
    int first;
    int end;
    bool open;                ///< in a root: whether its region reaches the border of the grid
    std::uint32_t connected;  ///< a run of the same region; the root's own index in the root
    std::uint32_t next;       ///< the next run of the same region
    std::uint32_t tail;       ///< in a root: the last one
};

/// Scratch memory of fillHoles.
struct FillScratch {
    std::vector<EmptyRun> runs;
    std::vector<std::uint8_t> on_rim;   ///< by cell; all 0 between the holes
    std::vector<std::uint32_t> filled;  ///< the cells of all holes so far
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
