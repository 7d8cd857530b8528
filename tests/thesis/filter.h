#pragma once

#include "reconstruct/image.h"
#include "thesis/surface.h"

/// The thesis' three filters.
namespace facescan::thesis {

/// What two vertices that follow each other on an image line may have between them.
struct LineLimits {
    double max_gap_px = 12;
    double max_depth_gap_mm = 6;
};

/// (a) Removes the vertices that are within either limit of neither the one before nor the one
/// behind on their image line. Vertices come line by line, in order along it.
void dropLonely(const LineLimits& limits, Surface& surface);

/// (a) Removes the vertices within a margin of the image's border.
void dropBorder(const Rect& image, double margin_px, Surface& surface);

/// (b) Removes the vertices whose depth lies outside the measurement range.
void dropOutOfRange(double min_mm, double max_mm, Surface& surface);

/// (c) Removes the faces whose longest edge is at least `ratio` times the mean of the longest
/// edges.
void dropLongFaces(double ratio, Surface& surface);

}  // namespace facescan::thesis
