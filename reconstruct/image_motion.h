#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/stripe_images.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// A similarity between two stripe images: a point p of the one stands at
/// middle + shift + (1 + scale) · R(turn) (p − middle) in the other.
struct ImageMotion {
    float column = 0;  ///< shift, px
    float y = 0;       ///< shift, px
    float turn = 0;    ///< rad, from the columns' axis towards y
    float scale = 0;   ///< relative change of size
};

/// A place in the stripe image, px.
struct ImagePoint {
    float column = 0;
    float y = 0;
};

/// Each pair's pattern + complement at half size, with a 1 2 1 blur along both axes: 64 grey levels
/// for each of the eight pixels that make up one.
struct HalfImages {
    int width = 0;
    int height = 0;
    int pairs = 0;
    std::vector<std::uint16_t> pixels;   ///< pair after pair
    std::vector<std::uint16_t> scratch;  ///< the last three rows of each pair before the blur

    const std::uint16_t* row(int pair, int y) const {
        return pixels.data() + (std::size_t(pair) * height + y) * width;
    }
};

/// Lays out half images that hold nothing yet.
void beginHalfImages(const StripeImages& images, HalfImages& halves);

/// Adds the row y of a pair's half image. Rows come in their order; with the last one the image is
/// complete.
void addRow(const StripeImages& images, int pair, int y, HalfImages& halves);

/// Scratch memory of estimateImageMotion.
struct ImageMotionScratch {
    std::vector<std::uint8_t> on_surface;

    // See RegistrationPixels and WarpedPixels.
    int pixels = 0;
    std::vector<float> level, gradient_x, gradient_y, lever_x, lever_y;
    std::vector<std::int32_t> x, y;
    std::vector<float> part_x, part_y, weight;
    std::array<std::vector<std::int32_t>, 4> warped;
};

/// How the scene stands displaced in each pair's image against the finest pair's.
///
/// Pattern + complement shows the scene as if evenly lit (the thesis' texture 2). Each such image,
/// at half size and blurred, is registered to the finest pair's by Lucas and Kanade's method (1981)
/// with a similarity, a gain and an offset, on the pixels that show the measured surface, with
/// Tukey's weights against what does not move along.
///
/// @param halves  of all pairs
/// @param middle  the point about which the similarities turn and scale
/// @returns by pair; the finest pair's is zero, and so are those that the image does not determine
std::array<ImageMotion, kMaxBits> estimateImageMotion(const HalfImages& halves,
                                                      const VertexGrid& grid,
                                                      const ImagePoint& middle,
                                                      ImageMotionScratch& scratch);

}  // namespace facescan
