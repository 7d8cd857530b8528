#include "sim/scene.h"

#include <Eigen/Geometry>
#include <utility>

namespace facescan::sim {

void computeNormals(Surface& surface) {
    surface.normals.assign(surface.positions.size(), Eigen::Vector3f::Zero());
    for (const Triangle& t : surface.triangles) {
        const Eigen::Vector3f& a = surface.positions[t[0]];
        const Eigen::Vector3f twice_area =
            (surface.positions[t[1]] - a).cross(surface.positions[t[2]] - a);
        for (const std::uint32_t vertex : t) surface.normals[vertex] += twice_area;
    }
    for (Eigen::Vector3f& normal : surface.normals) normal.normalize();
}

Scene transformed(Scene scene, const Pose& pose) {
    for (Eigen::Vector3f& p : scene.surface.positions) {
        p = (pose * p.cast<double>()).cast<float>();
    }
    const Eigen::Matrix3f rotation = pose.rotation.cast<float>();
    for (Eigen::Vector3f& n : scene.surface.normals) n = rotation * n;
    if (scene.sphere) scene.sphere->centre = pose * scene.sphere->centre;
    return scene;
}

Pose quarterTurn() {
    Pose pose;
    pose.rotation << 0, -1, 0,  //
        1, 0, 0,                //
        0, 0, 1;
    return pose;
}

Scene turnedSideways(Scene scene) {
    return transformed(std::move(scene), quarterTurn());
}

}  // namespace facescan::sim
