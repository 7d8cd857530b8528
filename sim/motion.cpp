#include "sim/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/random.h"

namespace facescan::sim {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kSines = 5;

/// A band of sines with random phases around `hz`, of standard deviation 1 over all time.
double tremor(double seconds, double hz, std::uint64_t seed, int channel) {
    double sum = 0;
    for (int i = 0; i < kSines; ++i) {
        const std::uint64_t id = std::uint64_t(channel * kSines + i);
        const double frequency = hz * (0.4 + 0.3 * i) * uniform(hashed(seed, id, 1), 0.9, 1.1);
        const double phase = uniform(hashed(seed, id, 2), 0, 2 * std::numbers::pi);
        sum += std::sin(2 * std::numbers::pi * frequency * seconds + phase);
    }
    return sum * std::sqrt(2.0 / kSines);
}

Pose rotatedAbout(const Eigen::Vector3d& pivot, const Eigen::Vector3d& rotation_rad,
                  const Eigen::Vector3d& translation) {
    const double angle = rotation_rad.norm();
    const Eigen::Vector3d axis =
        angle > 0 ? Eigen::Vector3d(rotation_rad / angle) : Eigen::Vector3d::UnitZ();
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    return {rotation, pivot - rotation * pivot + translation};
}

}  // namespace

bool Motion::isStill() const {
    return drift_mm.isZero(0) && drift_deg.isZero(0) && tremor_mm.isZero(0) && tremor_deg.isZero(0);
}

std::vector<Pose> posesOf(const Motion& motion, int frames, int first_frame, int pattern_frames,
                          double frame_interval_s, std::uint64_t seed) {
    std::vector<Pose> poses(frames);
    if (motion.isStill()) return poses;
    for (int frame = 0; frame < frames; ++frame) {
        const double share = double(frame - first_frame) / std::max(1, pattern_frames - 1);
        const double seconds = frame * frame_interval_s;
        Eigen::Vector3d shift = motion.drift_mm * share;
        Eigen::Vector3d turn = motion.drift_deg * share;
        for (int i = 0; i < 3; ++i) {
            shift[i] += motion.tremor_mm[i] * tremor(seconds, motion.tremor_hz, seed, i);
            turn[i] += motion.tremor_deg[i] * tremor(seconds, motion.tremor_hz, seed, 3 + i);
        }
        poses[frame] = rotatedAbout(motion.pivot_mm, turn * kDegree, shift);
    }
    const Pose to_world = poses[first_frame].inverse();
    for (Pose& pose : poses) pose = to_world * pose;
    poses[first_frame] = Pose{};
    return poses;
}

}  // namespace facescan::sim
