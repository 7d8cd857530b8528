#pragma once

#include <string>
#include <string_view>

#include "reconstruct/mesh.h"

namespace facescan {

/// Overwrites `out` with the mesh as OBJ text: millimetres, the scanner's frame; positions, texture
/// coordinates and normals in the digits that give the same floats back; one material, "face".
///
/// @param material_file  the name of the MTL file in the same folder, without white space
void formatObj(const Mesh& mesh, std::string_view material_file, std::string& out);

/// The MTL file that belongs to it.
///
/// @param texture_file  the name of the texture in the same folder, without white space
std::string formatMtl(std::string_view texture_file);

/// `stem` with what the text of OBJ and MTL files cannot carry in a file name (white space, control
/// characters, # \ " and a - in front) replaced by _.
std::string objFileStem(std::string_view stem);

}  // namespace facescan
