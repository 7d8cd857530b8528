#pragma once

#include "reconstruct/image.h"
#include "reconstruct/mesh.h"
#include "thesis/surface.h"

namespace facescan::thesis {

/// The surface as a mesh: with normals, the mean of those of the faces around a vertex by area, and
/// texture coordinates. A measured vertex has quality 1, a filled one 0.
/// @param image  the rectangle that the texture covers
Mesh toMesh(const Surface& surface, const Rect& image);

}  // namespace facescan::thesis
