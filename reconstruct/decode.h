#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/pixel_planes.h"
#include "reconstruct/stripe_images.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// A stripe edge as it was found in one column.
struct StripeEdge {
    float y;  ///< px along the code's axis
    EdgeLight light;
    std::uint16_t column;
    std::uint16_t code;  ///< the edge lies between the stripes code − 1 and code
    bool rising;         ///< whether the code rises with y here
};

struct DecodeCounts {
    int found = 0;    ///< zero crossings with sufficient modulation
    int decoded = 0;  ///< … whose neighbourhood names one stripe edge, in the device's direction
    bool rising = true;  ///< whether the code rises with y on this device
};

/// The second half of decoding: every Gray-code edge shows as the zero crossing of one pair's
/// normalised frame N = (P − C) / (P + C), and the signs of the other pairs there name it.
///
/// The neighbours c − 1 and c differ in one bit k of their codewords, and below k both read 10…0:
/// a crossing that contradicts this is no edge. Whether the projector is mounted so that the code
/// rises or falls is put to the vote; edges of the minority are dropped.
///
/// `edges` is scratch memory. The grid is overwritten.
DecodeCounts decodeEdges(const StripeImages& images, const PixelPlanes& planes,
                         const Options& options, std::vector<StripeEdge>& edges, VertexGrid& grid);

}  // namespace facescan
