#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/frame_stack.h"
#include "reconstruct/image.h"
#include "reconstruct/scan.h"

namespace facescan {

/// x^exponent for x and exponent from 0 to 1, to six digits, from basic arithmetic alone: the same
/// bits on every target, which the library's pow() does not promise.
double unitPower(double x, double exponent);

/// Scratch memory of makeTexture.
struct TextureScratch {
    double gamma = -1;                       ///< for which the table was made
    std::array<std::uint16_t, 511> table{};  ///< level of the sum of two pixels
    std::vector<std::uint16_t> corrected;    ///< one row, with the filter's reach at both ends
    std::vector<std::uint16_t> row_sums;     ///< rows around the one that is filtered
    std::vector<std::uint16_t> filtered;     ///< of the texture's size
    std::vector<std::uint16_t> column_sums;  ///< one row
    std::vector<std::uint16_t> no_row;       ///< one row of zeros
    std::vector<std::uint32_t> histogram;
};

/// Stage "texture": the mesh's texture from the pair with the finest pattern (the thesis' texture
/// 1): the pair's average, gamma correction, a 5 × 5 mean filter, and a histogram stretch that maps
/// the 0.5 and 99.5 % quantiles to 0 and 255.
///
/// @param gamma    exponent of the correction, above 0 to 1
/// @param texture  of the size of scan.image
void makeTexture(const FrameStackView& frames, const ScanDescription& scan, double gamma,
                 TextureScratch& scratch, GreyImage& texture);

}  // namespace facescan
