#pragma once

#include "reconstruct/calibration.h"
#include "thesis/surface.h"

namespace facescan::thesis {

/// The calibration's polynomials, term by term as the bundle format writes them.
SpacePoint toMillimetres(const Calibration& calibration, const PlanePoint& place, double code);

}  // namespace facescan::thesis
