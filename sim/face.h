#pragma once

#include "sim/face_parameters.h"
#include "sim/scene.h"

namespace facescan::sim {

/// A head with neck and shoulders before the scanner, a wall behind it.
///
/// @param cell_mm  size of the mesh's cells: the smallest detail
/// @param threads  0: one per core
Scene makeFace(const FaceParameters& parameters, double cell_mm = 0.6, int threads = 0);

}  // namespace facescan::sim
