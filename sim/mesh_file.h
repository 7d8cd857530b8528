#pragma once

#include <filesystem>

#include "sim/scene.h"

namespace facescan::sim {

/// How a mesh from a file stands before the scanner.
struct MeshPlacement {
    bool in_scanner_frame = false;      ///< take it as it is; the rest then counts for nothing
    double height_mm = 0;               ///< scale to this height; 0: the file is in millimetres
    double nearest_mm = 380;            ///< depth of its nearest point
    double offset_x_mm = 0;             ///< to the image's right, from the camera's axis
    double offset_y_mm = 0;             ///< downwards
    double yaw_deg = 0;                 ///< about its own vertical axis
    Material material = {0.5f, 0.05f};  ///< where the file has no vertex colours
};

/// Loads a PLY, OBJ or any other mesh that assimp reads. Unless it is in the scanner's frame, it
/// has Y up and looks along +Z; the middle of its bounding box is put on the camera's axis, or
/// beside it. Vertex colours become albedo. Throws std::runtime_error where the file holds no
/// triangles.
Scene loadMesh(const std::filesystem::path& path, const MeshPlacement& placement = {});

}  // namespace facescan::sim
