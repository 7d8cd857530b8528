#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "export/atomic_file.h"
#include "reconstruct/image.h"
#include "reconstruct/mesh.h"

namespace facescan {

/// The file formats of meshes. PLY, OBJ and STL keep millimetres and the scanner's frame; GLB has
/// metres and Y up, as glTF demands.
enum class MeshFormat { ply, obj, stl, glb };

/// The format's name, which is also its files' extension without the dot: "ply".
const char* name(MeshFormat format);

/// The format of that name, in upper or lower case; nothing where there is none.
std::optional<MeshFormat> parseMeshFormat(std::string_view name);

/// The format that the file's extension names; nothing where it names none.
std::optional<MeshFormat> meshFormatOf(const std::filesystem::path& file);

/// Writes the mesh, and what belongs to it into the same folder: for `dir/mesh.ply` the texture is
/// `dir/texture.png`; for `dir/mesh.obj` there are `dir/mesh.mtl` and `dir/mesh.png` (white space
/// in a name becomes _ there, for OBJ cannot name such a file); GLB holds its texture; STL has
/// none.
///
/// Whole files or none; the folder must exist. Throws WriteError.
///
/// @param mesh     numbers finite; it may be empty
/// @param texture  not empty
void writeMesh(const std::filesystem::path& file, const Mesh& mesh, const GreyImage& texture,
               MeshFormat format, Durability durability = Durability::synced);

}  // namespace facescan
