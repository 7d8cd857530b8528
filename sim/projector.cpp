#include "sim/projector.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace facescan::sim {

Pose aim(const Eigen::Vector3d& centre, const Eigen::Vector3d& target,
         const Eigen::Vector3d& code_direction, double roll_deg) {
    const Eigen::Vector3d forward = (target - centre).normalized();
    const Eigen::Vector3d down =
        (code_direction - forward * forward.dot(code_direction)).normalized();
    Eigen::Matrix3d rows;
    rows << down.cross(forward).transpose(), down.transpose(), forward.transpose();
    const Eigen::AngleAxisd roll(roll_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
    const Eigen::Matrix3d rotation = roll.toRotationMatrix() * rows;
    return {rotation, -(rotation * centre)};
}

ProjectorPoint locate(const Projector& projector, const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = projector.pose * point;
    return {p.x() / p.z() / projector.tan_x, (p.y() / p.z() / projector.tan_y + 1) / 2, p.z()};
}

int stripesShown(const Projector& projector, int stripes) {
    return projector.stripes_shown > 0 ? std::min(projector.stripes_shown, stripes) : stripes;
}

double blurAt(const Projector& projector, double depth_mm) {
    const double out_of_focus = projector.defocus * std::abs(depth_mm / projector.focus_mm - 1);
    return std::hypot(projector.blur, out_of_focus);
}

}  // namespace facescan::sim
