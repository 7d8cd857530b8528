#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/kernels/kernels.h"
#include "reconstruct/options.h"
#include "reconstruct/pixel_planes.h"
#include "reconstruct/place_ranges.h"
#include "reconstruct/stripe_images.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

struct DecodeCounts {
    int found = 0;    ///< zero crossings with sufficient modulation
    int decoded = 0;  ///< … whose neighbourhood names one stripe edge, in the device's direction
    int out_of_range = 0;  ///< … but cannot lie in the measurement range
    bool rising = true;    ///< whether the code rises with y on this device
};

/// Scratch memory of decodeEdges.
struct DecodeScratch {
    std::vector<std::uint8_t> edge_class;  ///< of the image's size, and a group of pixels beyond
    std::vector<int> ambiguous;            ///< by row
    EdgeBatch batch;
};

/// The second half of decoding: every Gray-code edge shows as the zero crossing of one pair's
/// normalised frame N = (P − C) / (P + C), and the signs of the other pairs there name it.
///
/// The neighbours c − 1 and c differ in one bit k of their codewords, and below k both read 10…0:
/// a crossing that contradicts this is no edge. Whether the projector is mounted so that the code
/// rises or falls is put to the vote; edges of the minority are dropped.
///
/// The place is that of a line through four pixels with the weights ½ 1 1 ½, or through the inner
/// two where the outer two belong to something else. Edges that cannot be in range are left out:
/// the wall behind the patient costs nothing. The grid is overwritten.
DecodeCounts decodeEdges(const StripeImages& images, const PixelPlanes& planes,
                         const PlaceRanges& ranges, const Options& options, DecodeScratch& scratch,
                         VertexGrid& grid);

}  // namespace facescan
