#pragma once

#include <string>
#include <string_view>

#include "reconstruct/mesh.h"

namespace facescan {

/// Overwrites `out` with the mesh as binary glTF 2.0: metres, Y up, +Z towards the viewer, that is
/// (x, −y, −z) / 1000 of the scanner's frame; the texture's origin at the top left, its PNG file
/// inside. Both sides of the surface are drawn. An empty mesh becomes a scene with an empty node.
///
/// @param texture_png  the bytes of a PNG file
void formatGlb(const Mesh& mesh, std::string_view texture_png, std::string& out);

}  // namespace facescan
