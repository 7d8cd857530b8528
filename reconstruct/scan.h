#pragma once

#include "reconstruct/calibration.h"
#include "reconstruct/image.h"
#include "reconstruct/pattern.h"

namespace facescan {

/// What was projected, which frames and pixels of a frame stack count, and the calibration: the
/// meaning of a stack of frames (bundle format, scan.xml).
struct ScanDescription {
    int first_frame = 0;  ///< the pattern frames are first_frame … + pattern.frameCount() − 1
    Rect image;           ///< the rectangle of each frame that is reconstructed
    Pattern pattern;
    Calibration calibration;

    friend bool operator==(const ScanDescription&, const ScanDescription&) = default;
};

}  // namespace facescan
