#pragma once

#include <cstdint>
#include <vector>

#include "thesis/surface.h"

namespace facescan::thesis {

/// The surface's boundary as closed walks, each vertex once a walk. They run with the faces beside
/// them: counter-clockwise around the outside, clockwise around a hole.
std::vector<std::vector<std::uint32_t>> boundaryLoops(const std::vector<Triangle>& faces);

/// Closes every hole by a fan: a vertex in the middle of the rim, joined to each edge of the rim.
void fillHoles(Surface& surface);

}  // namespace facescan::thesis
