#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/pose.h"

namespace facescan::sim {

/// How the hand moves the scanner during a scan: a steady drift and a tremor, either of which may
/// be zero.
struct Motion {
    Eigen::Vector3d drift_mm =
        Eigen::Vector3d::Zero();  ///< from the first to the last pattern frame
    Eigen::Vector3d drift_deg = Eigen::Vector3d::Zero();   ///< likewise, a rotation vector
    Eigen::Vector3d tremor_mm = Eigen::Vector3d::Zero();   ///< standard deviation, each axis
    Eigen::Vector3d tremor_deg = Eigen::Vector3d::Zero();  ///< likewise
    double tremor_hz = 8;  ///< the middle of the tremor's band; a hand's is 6 to 12
    Eigen::Vector3d pivot_mm = {0, 0,
                                0};  ///< rotations are about this point of the scanner's frame

    bool isStill() const;
};

/// The scanner's pose in each frame, scanner to world. World is the scanner at `first_frame`.
///
/// @param frames         all frames, also those before and after the pattern frames
/// @param pattern_frames the number of pattern frames, over which the drift is spread
std::vector<Pose> posesOf(const Motion& motion, int frames, int first_frame, int pattern_frames,
                          double frame_interval_s, std::uint64_t seed);

}  // namespace facescan::sim
