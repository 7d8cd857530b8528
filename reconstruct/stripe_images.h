#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reconstruct/frame_stack.h"
#include "reconstruct/scan.h"

namespace facescan {

/// The pattern frames of a scan, cropped, and turned so that the code always changes from row to
/// row. All later stages work in this orientation; only calibration and the mesh know the other.
struct StripeImages {
    int bits = 0;
    int width = 0;   ///< px across the code's axis: the columns of the vertex grid
    int height = 0;  ///< px along the code's axis
    std::ptrdiff_t row_stride = 0;
    std::array<const std::uint8_t*, kMaxBits> pattern{};
    std::array<const std::uint8_t*, kMaxBits> complement{};

    const std::uint8_t* patternRow(int pair, int y) const { return pattern[pair] + row_stride * y; }
    const std::uint8_t* complementRow(int pair, int y) const {
        return complement[pair] + row_stride * y;
    }
};

/// Stage "preprocess": discards the frames that carry no pattern and the pixels outside the image
/// rectangle. For stripes along the image rows nothing is copied. For stripes along the columns the
/// images lie in `buffer`, to which turnFrame() brings each frame.
StripeImages stripeImages(const FrameStackView& frames, const ScanDescription& scan,
                          std::vector<std::uint8_t>& buffer);

/// Transposes a frame into its stripe image, where stripes lie along the columns.
/// @param index   among the pattern frames, 0 … scan.pattern.frameCount() − 1
/// @param buffer  laid out by stripeImages()
void turnFrame(const FrameStackView& frames, const ScanDescription& scan, int index,
               std::vector<std::uint8_t>& buffer);

}  // namespace facescan
