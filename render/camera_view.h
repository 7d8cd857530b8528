#pragma once

#include <Eigen/Core>

#include "reconstruct/mesh.h"

namespace facescan {

/// From where a mesh is looked at: the scanner's own viewpoint, gone round the mesh's middle.
struct Viewpoint {
    float right_deg = 0;  ///< to the scanner's right (+X), −90 … 90
    float up_deg = 0;     ///< upwards (−Y), −90 … 90
};

/// The transformations of OpenGL for a perspective view, column-major.
struct CameraView {
    Eigen::Matrix4f view;        ///< scanner's frame (mm) to eye space: X right, Y up, Z backwards
    Eigen::Matrix4f projection;  ///< eye space to clip space
};

/// A view that fits the whole mesh tightly into a picture, with its extents in the middle.
///
/// The eye keeps the distance at which the scanner saw the mesh, so that the perspective is the one
/// of the scan. Vertices with a coordinate that is not finite are left out of account; an empty
/// mesh gives a valid view of nothing.
///
/// @param aspect  width / height of the picture
/// @param margin  share of the picture's width and height left free on each side, below 0.5
CameraView frameMesh(const Mesh& mesh, const Viewpoint& viewpoint, float aspect,
                     float margin = 0.05f);

}  // namespace facescan
