#pragma once

#include <string>

#include "reconstruct/mesh.h"

namespace facescan {

/// The texture's file name, as the format of mesh.ply asks.
inline constexpr const char* kPlyTextureName = "texture.png";

/// Overwrites `out` with the mesh as a binary little-endian PLY (bundle format, "mesh.ply"): float
/// x y z, nx ny nz, s t, quality, and `list uchar uint vertex_indices`; millimetres, the scanner's
/// frame. What `out` has allocated is reused.
void formatPly(const Mesh& mesh, std::string& out);

}  // namespace facescan
