#include "sim/face.h"

#include <Eigen/Geometry>
#include <numbers>

#include "sim/face_shape.h"
#include "sim/face_skin.h"
#include "sim/parallel.h"
#include "sim/surface_nets.h"

namespace facescan::sim {

namespace {

constexpr double kBackdropZ = 900;

/// What the scanner can see of a head: the back of it is left out.
const Eigen::AlignedBox3f kVisible(Eigen::Vector3f(-130, -215, -45),
                                   Eigen::Vector3f(130, 135, 125));

/// From the head's frame (Y up, Z towards the viewer) to the scanner's.
Pose headPose(const FaceParameters& f, float nose_tip_z) {
    constexpr double kDegree = std::numbers::pi / 180;
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(f.yaw_deg * kDegree, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(-f.pitch_deg * kDegree, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(-f.roll_deg * kDegree, Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    const Eigen::Vector3d middle(0, -10, 40);  // about which the head turns
    const Pose in_place{turn, middle - turn * middle};
    const Pose to_scanner{
        Eigen::DiagonalMatrix<double, 3>(1, -1, -1),
        Eigen::Vector3d(f.offset_x_mm, f.offset_y_mm, f.nose_distance_mm + double(nose_tip_z))};
    return to_scanner * in_place;
}

}  // namespace

Scene makeFace(const FaceParameters& parameters, double cell_mm, int threads) {
    const FaceShape shape(parameters);
    const auto field = [&](const Eigen::Vector3f& p) { return shape.distance(p); };
    IsoSurface iso = meshZeroSet(field, kVisible, float(cell_mm), threads);

    Scene scene{.kind = "face"};
    scene.backdrop_z_mm = kBackdropZ;
    Surface& surface = scene.surface;
    surface.materials.resize(iso.positions.size());
    constexpr int kChunk = 4096;
    const int count = int(iso.positions.size());
    forEach((count + kChunk - 1) / kChunk, threads, [&](int chunk) {
        for (int i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
            surface.materials[i] = faceMaterial(shape, parameters, iso.positions[i]);
        }
    });
    surface.positions = std::move(iso.positions);
    surface.triangles = std::move(iso.triangles);
    computeNormals(surface);
    return transformed(std::move(scene), headPose(parameters, shape.noseTipZ()));
}

}  // namespace facescan::sim
