#pragma once

#include <Eigen/Core>

#include "reconstruct/calibration.h"
#include "sim/device.h"

namespace facescan::sim {

/// How far a fitted calibration is from the exact device, over the measurement volume (mm).
struct FitResidual {
    Eigen::Vector3d rms_xyz = Eigen::Vector3d::Zero();
    double rms = 0;  ///< of the distance
    double max = 0;
    int samples = 0;
};

struct CalibrationFit {
    Calibration calibration;
    FitResidual residual;
};

/// The least-squares polynomials of `degree` (1 … 5) for a device and a pattern of `stripes`: on a
/// lattice of pixels of the image rectangle and of depths of the range, where the projector shows.
/// Throws std::invalid_argument where that is too little to determine them.
CalibrationFit fitCalibration(const Device& device, int stripes, int degree = 5);

/// The millimetres that a calibration gives for a pixel and a code.
Eigen::Vector3d evaluate(const Calibration& calibration, double x, double y, double code);

}  // namespace facescan::sim
