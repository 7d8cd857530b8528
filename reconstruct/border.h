#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/calibrate.h"
#include "reconstruct/image_motion.h"
#include "reconstruct/options.h"
#include "reconstruct/pixel_planes.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// The stripes as the pixels show them, and what they mean.
struct SeenStripes {
    const GridCalibration& calibration;
    const PixelPlanes& planes;
    const std::array<ImageMotion, kMaxBits>& motions;  ///< by pair
    int bits;
    bool rising;  ///< whether the code rises with y
};

/// Scratch memory of carryToBorder.
struct BorderScratch {
    // Of one row.
    std::vector<std::uint8_t> last;  ///< flags
    std::vector<float> width;        ///< of the next stripe, px
    std::vector<float> shown;        ///< how much of it the pixels show, px
};

/// Carries the surface on from the last edge of each column to its border: to where the image ends,
/// another surface begins, or the light no longer reaches it. The pixels show that the surface goes
/// on there, but no further edge is known on it. The cell of the next edge is filled: where the
/// pixels show that edge if its pair saw the face as it stands, else on the way to where it should
/// lie, as far as the pixels show the stripe before it. It is joined to nothing beyond that is
/// farther than a stripe: see VertexGrid::gaps.
///
/// @param points  of all cells that are not empty; those of the filled cells are added
/// @returns the number of cells filled
int carryToBorder(const Options& options, const SeenStripes& seen, BorderScratch& scratch,
                  VertexGrid& grid, PointPlanes& points);

}  // namespace facescan
