#include "sim/face_skin.h"

#include <algorithm>
#include <cmath>

#include "sim/noise_field.h"

namespace facescan::sim {

namespace {

using Point = Eigen::Vector3f;

/// 0 below `low`, 1 above `high`, smooth between (low may be the larger).
float ramp(float value, float low, float high) {
    const float t = std::clamp((value - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

float blend(float a, float b, float t) {
    return a + (b - a) * t;
}

Material eyeMaterial(const FaceShape& shape, const FaceParameters& parameters, const Point& p) {
    const Point q = p - shape.eye(p);
    const float r = std::hypot(q.x(), q.y());
    const float lash_shadow = ramp(shape.eyelids(p), -2.5f, -0.3f);
    float albedo = blend(0.62f, 0.5f, ramp(r, 8, 13));
    albedo = blend(parameters.iris_albedo, albedo, ramp(r, 5.4f, 6.0f));
    albedo = blend(albedo, 0.4f * albedo, ramp(r, 4.6f, 5.4f) * ramp(r, 6.0f, 5.4f));
    albedo = blend(0.02f, albedo, ramp(r, 2.1f, 2.7f));
    return {albedo * (1 - 0.6f * lash_shadow), 0.12f};
}

/// How much of the skin an eyebrow's hairs cover.
float browCover(const FaceShape& shape, const FaceParameters& parameters, const Point& p) {
    const Point eye = shape.eye(p);
    const float x = std::copysign(1.0f, eye.x()) * (p.x() - eye.x());
    if (p.z() < 40 || std::abs(x) > 26) return 0;
    const float middle =
        eye.y() + 18.5f + 0.16f * x - 0.013f * std::max(0.0f, x) * x - 0.004f * x * x;
    const float half_height = blend(4.6f, 1.6f, ramp(x, -16, 21));
    const float body = ramp(std::abs(p.y() - middle), half_height, half_height * 0.35f);
    const float ends = ramp(x, -20, -13) * ramp(x, 22, 16);
    const Point hairs = {0.7f * p.x() - 0.5f * eye.x() / 31 * p.y(), 0.35f * p.y(), 0.2f * p.z()};
    const float strands = 0.8f + 0.5f * fractalNoise(hairs, 2, parameters.seed + 7);
    return std::clamp(body * ends * strands, 0.0f, 1.0f);
}

float skinTexture(const FaceParameters& parameters, const Point& p) {
    const float blotches = 0.06f * fractalNoise(p * 0.035f, 3, parameters.seed + 1);
    const float pores = 0.05f * fractalNoise(p * 0.45f, 2, parameters.seed + 2);
    const float freckle = ramp(valueNoise(p * 0.55f, parameters.seed + 3), 0.75f, 0.95f);
    return 1 + blotches + pores - 0.12f * freckle;
}

}  // namespace

Material faceMaterial(const FaceShape& shape, const FaceParameters& parameters,
                      const Point& point) {
    const Point p = shape.averaged(point);
    const float skin = shape.skin(p);
    const bool in_eye = shape.eyelids(p) < 0 && p.z() > shape.eye(p).z() &&
                        (p - shape.eye(p)).norm() < FaceShape::kEyeRadius + 1.1f;
    if (in_eye) return eyeMaterial(shape, parameters, p);

    float albedo = parameters.skin_albedo * skinTexture(parameters, p);
    // Blood under the skin: cheeks, the tip of the nose, ears.
    const float cheeks = ramp((p - Point(std::copysign(38.0f, p.x()), -32, 68)).norm(), 28, 8);
    albedo *= 1 - 0.07f * cheeks;
    // Thin skin around the eyes, the inside of the nostrils.
    const float around_eye = ramp((p - shape.eye(p)).norm(), 25, 14);
    albedo *= 1 - 0.14f * around_eye;

    const float lips = ramp(shape.lips(p), 1.3f, 0.3f) * (p.z() > 55 ? 1.0f : 0.0f);
    const float chapped = 1 + 0.1f * fractalNoise({p.x(), p.y() * 0.2f, 0}, 2, parameters.seed + 4);
    albedo = blend(albedo, 0.66f * parameters.skin_albedo * chapped, lips);

    const float lashes = ramp(shape.eyelids(p), 1.3f, 0.2f) *
                         ramp((p - shape.eye(p)).norm(), 17, 14.5f) * (p.z() > 50 ? 1.0f : 0.0f);
    const float upper = p.y() > shape.eye(p).y() ? 0.9f : 0.45f;
    albedo = blend(albedo, 0.03f, lashes * upper);
    albedo = blend(albedo, 0.8f * parameters.hair_albedo, 0.9f * browCover(shape, parameters, p));

    if (parameters.beard != Beard::none) {
        const float full = parameters.beard == Beard::full ? 0.85f : 0.45f;
        const float hairs = 0.85f + 0.5f * fractalNoise(p * 0.8f, 2, parameters.seed + 5);
        const float cover = std::clamp(shape.beardCover(p) * full * hairs, 0.0f, 1.0f);
        albedo = blend(albedo, parameters.hair_albedo, cover);
    }
    float specular = 0.05f + 0.04f * lips;
    if (parameters.hair != HairStyle::bald) {
        const float strands = 1 + 0.5f * fractalNoise({p.x() * 0.7f, p.y() * 0.08f, p.z() * 0.15f},
                                                      3, parameters.seed + 6);
        const float cover = ramp(shape.hair(p) - skin, 2.0f, -0.5f);
        albedo = blend(albedo, parameters.hair_albedo * strands, cover);
        specular = blend(specular, 0.03f, cover);
    }
    return {std::clamp(albedo, 0.01f, 0.95f), specular};
}

}  // namespace facescan::sim
