#include "sim/samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/random.h"

namespace facescan::sim {

namespace {

constexpr float kShadowOffset = 0.02f;  // mm off the surface at which a shadow ray starts
constexpr float kBlurReach = 4;         // standard deviations after which a stripe's light ends

/// A point of the scene as shading needs it, in world coordinates.
struct Point {
    Eigen::Vector3f position;
    Eigen::Vector3f facet_normal;  // towards the camera
    Eigen::Vector3f normal;        // smooth, on the same side
    Material material;
};

Point surfacePoint(const Surface& surface, const Ray& ray, const Hit& hit) {
    const Triangle& t = surface.triangles[hit.triangle];
    const float w = 1 - hit.u - hit.v;
    const Eigen::Vector3f &a = surface.positions[t[0]], &b = surface.positions[t[1]],
                          &c = surface.positions[t[2]];
    const Material &ma = surface.materials[t[0]], &mb = surface.materials[t[1]],
                   &mc = surface.materials[t[2]];
    Point p;
    p.position = w * a + hit.u * b + hit.v * c;
    p.facet_normal = (b - a).cross(c - a).normalized();
    p.normal =
        (w * surface.normals[t[0]] + hit.u * surface.normals[t[1]] + hit.v * surface.normals[t[2]])
            .normalized();
    p.material = {w * ma.albedo + hit.u * mb.albedo + hit.v * mc.albedo,
                  w * ma.specular + hit.u * mb.specular + hit.v * mc.specular};
    if (p.facet_normal.dot(ray.direction) > 0) p.facet_normal = -p.facet_normal;
    if (p.normal.dot(p.facet_normal) < 0) p.normal = -p.normal;
    return p;
}

Point backdropPoint(const Scene& scene, const Ray& ray, const Hit& hit) {
    const Eigen::Vector3f towards(0, 0, -1);
    return {ray.origin + hit.t * ray.direction, towards, towards, {scene.backdrop_albedo, 0}};
}

/// (n · h)^18: the width of a highlight on skin.
float highlight(float cosine) {
    const float c = std::max(0.0f, cosine), c2 = c * c, c4 = c2 * c2, c8 = c4 * c4;
    return c8 * c8 * c2;
}

float reflected(const Point& p, const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_eye) {
    const float incidence = std::max(0.0f, p.normal.dot(to_light));
    const Eigen::Vector3f half = (to_light + to_eye).normalized();
    return incidence * (p.material.albedo + p.material.specular * highlight(p.normal.dot(half)));
}

/// Appends the shares of the stripes around `code` in the light there. Outside the shown stripes
/// there is no light.
void addStripeWeights(float code, float sigma, int shown, Sample& sample, SampleBand& band) {
    const float reach = kBlurReach * sigma;
    const int first = std::max(0, int(std::floor(code - reach)));
    const int last = std::min({shown - 1, int(std::floor(code + reach)), first + 254});
    sample.first_stripe = first;
    sample.first_weight = std::uint32_t(band.weights.size());
    sample.weight_count = std::uint8_t(std::max(0, last - first + 1));
    float below = normalShareBelow((float(first) - code) / sigma);
    for (int stripe = first; stripe <= last; ++stripe) {
        const float next = normalShareBelow((float(stripe + 1) - code) / sigma);
        band.weights.push_back(next - below);
        below = next;
    }
}

}  // namespace

std::vector<Eigen::Vector3f> viewingRays(const Camera& camera, const SampleWindow& window) {
    const int columns = window.sampleColumns(camera.width);
    std::vector<Eigen::Vector3f> rays;
    rays.reserve(std::size_t(window.sampleRows()) * columns);
    const double step = 1.0 / window.per_side;
    const double left = -window.margin_px - 0.5 + step / 2;
    for (int row = 0; row < window.sampleRows(); ++row) {
        const double y = window.first_row + left + row * step;
        for (int column = 0; column < columns; ++column) {
            rays.push_back(camera.ray({left + column * step, y}).cast<float>());
        }
    }
    return rays;
}

SampleBand trace(const RayCaster& caster, const Scene& scene, const Device& device, int stripes,
                 const Pose& pose, std::span<const Eigen::Vector3f> viewing, int columns) {
    const Eigen::Matrix3f rotation = pose.rotation.cast<float>();
    const Eigen::Vector3f eye = pose.translation.cast<float>();
    const Projector& projector = device.projector;
    const Eigen::Vector3f light = (pose * projector.centre()).cast<float>();
    const Pose world_to_projector = projector.pose * pose.inverse();
    Projector at_pose = projector;
    at_pose.pose = world_to_projector;
    const int shown = stripesShown(projector, stripes);

    SampleBand band;
    band.samples.resize(viewing.size());
    std::vector<Ray> rays(columns), shadow_rays(columns);
    std::vector<Hit> hits(columns);
    std::vector<std::uint8_t> blocked(columns);
    for (std::size_t begin = 0; begin < viewing.size(); begin += columns) {
        for (int i = 0; i < columns; ++i) rays[i] = {eye, rotation * viewing[begin + i]};
        caster.closest(rays, hits);

        for (int i = 0; i < columns; ++i) {
            Sample& sample = band.samples[begin + i];
            sample.hit = hits[i].target == Hit::Target::surface;
            shadow_rays[i] = {eye, Eigen::Vector3f::UnitZ(), 0, -1};
            if (hits[i].target == Hit::Target::nothing) continue;
            const Point p = sample.hit ? surfacePoint(scene.surface, rays[i], hits[i])
                                       : backdropPoint(scene, rays[i], hits[i]);
            sample.ambient = float(device.ambient) * p.material.albedo;
            const Eigen::Vector3f to_light = light - p.position;
            const ProjectorPoint at = locate(at_pose, p.position.cast<double>());
            if (!at.inField() || p.facet_normal.dot(to_light) <= 0) continue;
            const float distance = to_light.norm();
            const float falloff = float(projector.reference_mm) / distance;
            sample.direct = falloff * falloff *
                            reflected(p, to_light / distance, -rays[i].direction.normalized());
            sample.lit = true;
            shadow_rays[i] = {p.position + kShadowOffset * p.facet_normal, to_light, 0, 1};
            addStripeWeights(float(at.along * shown), float(blurAt(projector, at.depth)), shown,
                             sample, band);
        }
        caster.blocked(shadow_rays, blocked);
        for (int i = 0; i < columns; ++i) {
            Sample& sample = band.samples[begin + i];
            if (sample.lit && blocked[i]) {
                sample.direct = 0;
                sample.weight_count = 0;
                sample.lit = false;
            }
        }
    }
    return band;
}

void illuminate(const SampleBand& band, std::span<const float> picture, std::span<float> radiance) {
    for (std::size_t i = 0; i < band.samples.size(); ++i) {
        const Sample& sample = band.samples[i];
        const float* weights = band.weights.data() + sample.first_weight;
        const float* brightness = picture.data() + sample.first_stripe;
        float light = 0;
        for (int j = 0; j < sample.weight_count; ++j) light += weights[j] * brightness[j];
        radiance[i] = sample.ambient + sample.direct * light;
    }
}

}  // namespace facescan::sim
