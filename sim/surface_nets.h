#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "reconstruct/mesh.h"

namespace facescan::sim {

/// A signed distance (mm), negative inside. Need not be exact; its slope stays below 1.5.
using DistanceField = std::function<float(const Eigen::Vector3f&)>;

struct IsoSurface {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Triangle> triangles;  ///< counter-clockwise seen from outside
};

/// Meshes the zero set of `field` inside `box` with cells of `cell_mm`; every vertex is then moved
/// onto the zero set. The surface stays open where it leaves the box, which is rounded up to whole
/// cubes of 16 cells.
/// Source: S. F. Gibson, "Constrained elastic surface nets", MICCAI 1998 (the naive form).
IsoSurface meshZeroSet(const DistanceField& field, const Eigen::AlignedBox3f& box, float cell_mm,
                       int threads);

}  // namespace facescan::sim
