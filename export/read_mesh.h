#pragma once

#include <filesystem>
#include <stdexcept>

#include "reconstruct/image.h"
#include "reconstruct/mesh.h"

namespace facescan {

/// A file is no mesh by the format, or its texture is not to be had: "PATH: CAUSE", in one line.
class ReadError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct TexturedMesh {
    Mesh mesh;
    GreyImage texture;
};

/// Reads a PLY file by the bundle format ("mesh.ply") and the texture beside it that it names.
/// Further vertex properties may stand among those of the format, in any order; where there are no
/// normals, they are worked out from the faces. Nothing is trusted: memory stays within a small
/// multiple of the files' size, and whatever breaks a rule throws ReadError.
TexturedMesh readMesh(const std::filesystem::path& file);

}  // namespace facescan
