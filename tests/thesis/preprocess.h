#pragma once

#include <vector>

#include "reconstruct/frame_stack.h"
#include "reconstruct/scan.h"
#include "thesis/image.h"
#include "thesis/surface.h"

namespace facescan::thesis {

/// Discards the frames that carry no pattern, crops the others, scales them to 0 … 1 and puts them
/// in pairs, the coarsest first.
std::vector<FramePair> preprocess(const FrameStackView& frames, const ScanDescription& scan);

/// Transposes the images where stripes lie along columns: afterwards they lie along rows.
void layStripesAlongRows(CodeAxis axis, std::vector<FramePair>& pairs);

/// Where a place in an image with stripes along its rows lies in the full frame.
PlanePoint placeInFrame(const ScanDescription& scan, PlanePoint place);

}  // namespace facescan::thesis
