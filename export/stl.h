#pragma once

#include <string>

#include "reconstruct/mesh.h"

namespace facescan {

/// Overwrites `out` with the mesh as a binary STL: millimetres, the scanner's frame, the normal of
/// each facet from its corners. STL has neither texture nor shared vertices.
void formatStl(const Mesh& mesh, std::string& out);

}  // namespace facescan
