#pragma once

#include <vector>

#include "thesis/image.h"

/// Motion compensation as the thesis does it: the frames are shifted by whole
/// pixels, across the stripes, until the scene stands still.
namespace facescan::thesis {

/// The mean of each row: the image summed along the stripes.
std::vector<double> profile(const Image& image);

/// The displacement d, −reach … reach, for which `to[i + d]` is most like `from[i]`: the one with
/// the smallest sum of absolute differences, divided by the number of rows that both have. Of
/// equals the shortest.
int displacement(const std::vector<double>& from, const std::vector<double>& to, int reach);

/// By how many rows each pair has to be moved down so that the scene lies where the finest pair
/// shows it. Consecutive pairs are compared, by the profiles of their evenly lit images.
std::vector<int> shiftsToFinestPair(const std::vector<FramePair>& pairs, int reach);

/// The image moved down by `rows`. What comes in at the border repeats the last row there.
Image movedDown(const Image& image, int rows);

}  // namespace facescan::thesis
