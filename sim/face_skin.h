#pragma once

#include "sim/face_shape.h"
#include "sim/scene.h"

namespace facescan::sim {

/// How the head reflects at a point of its surface: skin, lips, brows, lashes, eyes, hair, beard.
Material faceMaterial(const FaceShape& shape, const FaceParameters& parameters,
                      const Eigen::Vector3f& p);

}  // namespace facescan::sim
