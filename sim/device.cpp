#include "sim/device.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/scene.h"

namespace facescan::sim {

Device standardDevice() {
    Device device;
    const Eigen::Vector3d centre(1.5, -120, -3);
    const Eigen::Vector3d target(-1.2, 0, 400);
    device.projector.pose = aim(centre, target, Eigen::Vector3d::UnitY(), 0.25);
    return device;
}

Device withProjectorUpsideDown(Device device) {
    const Pose half_turn{Eigen::DiagonalMatrix<double, 3>(-1, -1, 1), Eigen::Vector3d::Zero()};
    device.projector.pose = half_turn * device.projector.pose;
    return device;
}

Device sideways(Device device) {
    Camera& camera = device.camera;
    const Rect upright = device.image;
    device.projector.pose = device.projector.pose * quarterTurn().inverse();
    device.axis = device.axis == CodeAxis::y ? CodeAxis::x : CodeAxis::y;
    // Columns become rows counted from the top, rows become columns counted from the right.
    device.image = {camera.height - upright.y - upright.height, upright.x, upright.height,
                    upright.width};
    camera = {camera.height, camera.width, camera.fy, camera.fx, camera.height - 1 - camera.cy,
              camera.cx,     camera.k1,    camera.k2, camera.p2, -camera.p1};
    return device;
}

Device resized(Device device, int width, int height) {
    Camera& camera = device.camera;
    const double sx = double(width) / camera.width, sy = double(height) / camera.height;
    const auto scaled = [](int value, double scale) { return int(std::lround(value * scale)); };
    Rect& image = device.image;
    const int right = std::min(width, scaled(image.x + image.width, sx));
    const int bottom = std::min(height, scaled(image.y + image.height, sy));
    image.x = scaled(image.x, sx);
    image.y = scaled(image.y, sy);
    image.width = right - image.x;
    image.height = bottom - image.y;
    camera.fx *= sx;
    camera.fy *= sy;
    // A pixel's edges scale, its centre lies half a pixel inside.
    camera.cx = (camera.cx + 0.5) * sx - 0.5;
    camera.cy = (camera.cy + 0.5) * sy - 0.5;
    camera.width = width;
    camera.height = height;
    return device;
}

}  // namespace facescan::sim
