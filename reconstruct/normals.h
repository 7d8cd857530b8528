#pragma once

#include "reconstruct/mesh.h"

namespace facescan {

/// Sets each vertex' normal: the mean of its triangles' normals weighted by area, of unit length,
/// on the side from which the triangles turn counter-clockwise.
void addNormals(Mesh& mesh);

}  // namespace facescan
