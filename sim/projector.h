#pragma once

#include <Eigen/Core>

#include "sim/pose.h"

namespace facescan::sim {

/// A pinhole projector whose stripes are planes through its centre. Its own frame has Z out of its
/// lens and Y along the rising code.
struct Projector {
    Pose pose;              ///< scanner to projector
    double tan_x = 0.45;    ///< half the field across the code: |X/Z| ≤ tan_x
    double tan_y = 0.38;    ///< half the field along the code: |Y/Z| ≤ tan_y
    int stripes_shown = 0;  ///< codes 0 … stripes_shown − 1 fill the field; 0: all of the pattern
    double blur = 0.28;     ///< standard deviation of a stripe's edge in focus, stripes
    double defocus = 1.5;       ///< … growing by this much a unit of |depth/focus − 1|, stripes
    double focus_mm = 420;      ///< depth of the sharpest picture, along the projector's Z
    double reference_mm = 420;  ///< distance at which the irradiance is 1
    double black = 0.02;        ///< light of a dark stripe, share of a lit one's

    Eigen::Vector3d centre() const { return pose.inverse().translation; }
};

/// Where a point lies in the projector's picture.
struct ProjectorPoint {
    double across = 0;  ///< −1 … 1 inside the field
    double along = 0;   ///< 0 … 1 inside the field, rising with the code
    double depth = 0;   ///< mm; not above 0 behind the projector

    bool inField() const {
        return depth > 0 && across >= -1 && across <= 1 && along >= 0 && along <= 1;
    }
};

/// Mounts a projector at `centre`, aimed at `target`, its code rising along `code_direction` as
/// far as the aim allows; then turned by `roll_deg` about its axis. All in the scanner's frame, mm.
Pose aim(const Eigen::Vector3d& centre, const Eigen::Vector3d& target,
         const Eigen::Vector3d& code_direction, double roll_deg = 0);

ProjectorPoint locate(const Projector& projector, const Eigen::Vector3d& point);

/// The number of stripes that fill the field for a pattern of `stripes`.
int stripesShown(const Projector& projector, int stripes);

/// The standard deviation of a stripe's edge at a depth, stripes.
double blurAt(const Projector& projector, double depth_mm);

}  // namespace facescan::sim
