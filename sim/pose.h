#pragma once

#include <Eigen/Core>

namespace facescan::sim {

/// A rigid motion p ↦ rotation · p + translation (mm).
struct Pose {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();

    Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return rotation * p + translation; }

    /// First `other`, then this.
    Pose operator*(const Pose& other) const {
        return {rotation * other.rotation, rotation * other.translation + translation};
    }

    Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }

    friend bool operator==(const Pose&, const Pose&) = default;
};

}  // namespace facescan::sim
