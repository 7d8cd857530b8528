#include "sim/ray_caster.h"

#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace facescan::sim {

namespace {

constexpr unsigned kSurface = 0, kBackdrop = 1;
constexpr float kBackdropHalfSize = 5000;

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

void check(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw std::runtime_error(std::string("ray casting: ") + what + " failed, Embree's error " +
                             std::to_string(int(error)) +
                             (error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

/// Copies a mesh to Embree, which pads it to its needs.
void attach(RTCDevice device, RTCScene scene, unsigned id,
            std::span<const Eigen::Vector3f> positions, std::span<const Triangle> triangles) {
    if (triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Eigen::Vector3f), positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(Triangle), triangles.size());
    check(device, "storing the scene");
    std::copy(positions.begin(), positions.end(), static_cast<Eigen::Vector3f*>(vertices));
    std::copy(triangles.begin(), triangles.end(), static_cast<Triangle*>(indices));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

RTCRay toEmbree(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x();
    r.org_y = ray.origin.y();
    r.org_z = ray.origin.z();
    r.tnear = ray.near;
    r.dir_x = ray.direction.x();
    r.dir_y = ray.direction.y();
    r.dir_z = ray.direction.z();
    r.tfar = ray.far;
    r.mask = ~0u;
    return r;
}

RTCIntersectContext coherentContext() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

}  // namespace

struct RayCaster::Embree {
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter> device;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter> scene;
};

RayCaster::RayCaster(const Scene& scene) : embree_(std::make_unique<Embree>()) {
    // One thread builds, so that the tree, and with it every tie between triangles, is always the
    // same.
    RTCDevice device = rtcNewDevice("threads=1");
    embree_->device.reset(device);
    check(device, "starting");
    RTCScene target = rtcNewScene(device);
    embree_->scene.reset(target);
    rtcSetSceneFlags(target, RTC_SCENE_FLAG_ROBUST);

    attach(device, target, kSurface, scene.surface.positions, scene.surface.triangles);
    if (scene.backdrop_z_mm > 0) {
        const float s = kBackdropHalfSize, z = float(scene.backdrop_z_mm);
        const std::array<Eigen::Vector3f, 4> corners = {
            Eigen::Vector3f(-s, -s, z), {-s, s, z}, {s, s, z}, {s, -s, z}};
        const std::array<Triangle, 2> triangles = {Triangle{0, 1, 2}, {0, 2, 3}};
        attach(device, target, kBackdrop, corners, triangles);
    }
    rtcCommitScene(target);
    check(device, "preparing the scene");
}

RayCaster::~RayCaster() = default;

void RayCaster::closest(std::span<const Ray> rays, std::span<Hit> hits) const {
    std::vector<RTCRayHit> stream(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        stream[i].ray = toEmbree(rays[i]);
        stream[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context = coherentContext();
    rtcIntersect1M(embree_->scene.get(), &context, stream.data(), unsigned(stream.size()),
                   sizeof(RTCRayHit));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RTCHit& h = stream[i].hit;
        hits[i] = {.target = h.geomID == kSurface    ? Hit::Target::surface
                             : h.geomID == kBackdrop ? Hit::Target::backdrop
                                                     : Hit::Target::nothing,
                   .triangle = h.primID,
                   .t = stream[i].ray.tfar,
                   .u = h.u,
                   .v = h.v};
    }
}

void RayCaster::blocked(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    std::vector<RTCRay> stream(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) stream[i] = toEmbree(rays[i]);
    RTCIntersectContext context = coherentContext();
    rtcOccluded1M(embree_->scene.get(), &context, stream.data(), unsigned(stream.size()),
                  sizeof(RTCRay));
    // Embree marks an occluded ray by a far end below all numbers.
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = stream[i].tfar < 0;
}

}  // namespace facescan::sim
