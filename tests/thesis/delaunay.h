#pragma once

#include <span>
#include <vector>

#include "reconstruct/mesh.h"
#include "thesis/surface.h"

namespace facescan::thesis {

/// The Delaunay triangulation of different points, by Qhull: no point lies inside the circle
/// through the corners of a triangle. Where more than three points lie on one circle any of their
/// triangulations is given. Triangles run counter-clockwise as one looks at the image.
///
/// Empty where the points lie on one line, or are fewer than three.
std::vector<Triangle> delaunay(std::span<const PlanePoint> points);

}  // namespace facescan::thesis
