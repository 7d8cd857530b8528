#include "sim/truth_maps.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "sim/parallel.h"

namespace facescan::sim {

namespace {

/// A plane of the scene: a triangle's, or the backdrop's.
struct Facet {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;
};

Facet facetOf(const Scene& scene, const Hit& hit) {
    if (hit.target == Hit::Target::backdrop) {
        return {Eigen::Vector3d(0, 0, scene.backdrop_z_mm), Eigen::Vector3d(0, 0, -1)};
    }
    const Surface& surface = scene.surface;
    const Triangle& t = surface.triangles[hit.triangle];
    const Eigen::Vector3d a = surface.positions[t[0]].cast<double>();
    const Eigen::Vector3d b = surface.positions[t[1]].cast<double>();
    const Eigen::Vector3d c = surface.positions[t[2]].cast<double>();
    return {a, (b - a).cross(c - a).normalized()};
}

}  // namespace

TruthMaps castTruthMaps(const RayCaster& caster, const Scene& scene, const Device& device,
                        int stripes, const Pose& pose, int frame, int threads) {
    const Camera& camera = device.camera;
    const std::size_t pixels = std::size_t(camera.width) * camera.height;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    TruthMaps maps;
    maps.frame = frame;
    maps.z.assign(pixels, nan);
    maps.cos_cam.assign(pixels, nan);
    maps.cos_proj.assign(pixels, nan);
    maps.inside.assign(pixels, 0);
    maps.hit.assign(pixels, 0);
    maps.lit.assign(pixels, 0);

    const int shown = stripesShown(device.projector, stripes);
    const Eigen::Vector3d projector_centre = device.projector.centre();
    const Pose to_scanner = pose.inverse();
    forEach(camera.height, threads, [&](int y) {
        std::vector<Eigen::Vector3d> viewing(camera.width);
        std::vector<Ray> rays(camera.width);
        std::vector<Hit> hits(camera.width);
        for (int x = 0; x < camera.width; ++x) {
            viewing[x] = camera.ray({double(x), double(y)});
            rays[x] = {pose.translation.cast<float>(), (pose.rotation * viewing[x]).cast<float>()};
        }
        caster.closest(rays, hits);
        for (int x = 0; x < camera.width; ++x) {
            if (hits[x].target == Hit::Target::nothing) continue;
            // The ray is met again in double precision: Embree's own is good to 0.1 µm a
            // millimetre.
            const Facet world = facetOf(scene, hits[x]);
            const Eigen::Vector3d point = to_scanner * world.point;
            Eigen::Vector3d normal = to_scanner.rotation * world.normal;
            if (normal.dot(viewing[x]) > 0) normal = -normal;
            const double z = normal.dot(point) / normal.dot(viewing[x]);
            const Eigen::Vector3d p = z * viewing[x];
            const ProjectorPoint at = locate(device.projector, p);
            const double code = at.along * shown;
            const std::size_t i = std::size_t(y) * camera.width + x;
            maps.z[i] = float(z);
            maps.cos_cam[i] = float(-normal.dot(p.normalized()));
            maps.cos_proj[i] = float(normal.dot((projector_centre - p).normalized()));
            maps.inside[i] = at.inField() && code >= 1 && code <= shown - 1;
        }
    });
    return maps;
}

}  // namespace facescan::sim
