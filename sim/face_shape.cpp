#include "sim/face_shape.h"

#include <algorithm>
#include <cmath>

#include "sim/distance.h"
#include "sim/noise_field.h"

// The numbers are the average adult head's, in mm, from anthropometric means (head 195 long, 152
// wide, 225 high; pupils 62 apart; nose 50 long, 36 wide; mouth 50 wide), then drawn by eye.
namespace facescan::sim {

using namespace distance;

namespace {

/// The same point on the side x ≥ 0.
Point mirrored(const Point& p) {
    return {std::abs(p.x()), p.y(), p.z()};
}

Point turnedAboutY(const Point& p, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * p.x() + s * p.z(), p.y(), -s * p.x() + c * p.z()};
}

}  // namespace

FaceShape::FaceShape(const FaceParameters& parameters) : parameters_(parameters) {
    const FaceParameters& f = parameters_;
    at_.eye = {31 * f.eye_spacing, 0, 62};
    at_.nose_root = {0, 5, 80.5f};
    at_.nose_tip = {0, 4 - 44 * f.nose_length, 84 + 14.5f * f.nose_height};
    at_.ala = {11.0f * f.nose_width, at_.nose_tip.y() - 2.5f, 84 + 4 * f.nose_height};
    at_.lip_half_width = 24.5f * f.mouth_width;
}

float FaceShape::noseTipZ() const {
    return at_.nose_tip.z() + 8.5f;
}

Point FaceShape::averaged(const Point& p) const {
    const float down = std::clamp(-p.y() / 112, 0.0f, 1.2f);
    const float lean = parameters_.asymmetry_mm * down;
    return {(p.x() - lean) / parameters_.width, p.y() < 0 ? p.y() / parameters_.length : p.y(),
            p.z()};
}

float FaceShape::distance(const Point& p) const {
    const Point q = averaged(p);
    float d = skin(q);
    if (parameters_.beard == Beard::full) {
        const float cover = beardCover(q);
        if (cover > 0) {
            const Point strand = {0.35f * q.x(), 0.12f * q.y(), 0.25f * q.z()};
            const float tufts = 0.8f + 0.5f * fractalNoise(strand, 3, parameters_.seed + 40);
            d -= 3.0f * cover * cover * tufts;
        }
    }
    d = std::min(d, eyeball(q));
    if (parameters_.hair != HairStyle::bald) d = smoothUnion(d, hair(q), 2);
    return d;
}

float FaceShape::skin(const Point& p) const {
    float d = skull(p);
    d = withChin(d, p);
    d = withEyeSocket(d, p);
    d = withMouth(d, p);
    d = withNose(d, p);
    d = smoothUnion(d, neck(p), 8);
    return withEar(d, p);
}

float FaceShape::skull(const Point& p) const {
    const Point m = mirrored(p);
    const FaceParameters& f = parameters_;
    float d = ellipsoid(p, {0, 22, -8}, {74, 90, 93});
    d = smoothUnion(d, ellipsoid(p, {0, -24, 12}, {62, 68, 67}), 22);
    d = smoothUnion(d, ellipsoid(p, {0, -60, 32}, {47 * f.jaw_width, 48, 46}), 18);
    d = smoothUnion(d, taperedCapsule(m, {44 * f.jaw_width, -50, 4}, {15, -98, 60}, 13, 11), 28);
    const float cheek = 4 * (f.cheekbones - 1);
    d = smoothUnion(d, ellipsoid(m, {40 + cheek / 2, -25, 50 + cheek}, {22, 17, 22}), 24);
    d = smoothUnion(d, ellipsoid(m, {33, -54, 37}, {20, 27, 26}), 20);
    const float brow = 2.5f * (f.brow_ridge - 1);
    float ridge = taperedCapsule(m, {13, 14, 78 + brow}, {32, 19, 74 + brow}, 8, 8);
    ridge = std::min(ridge, taperedCapsule(m, {32, 19, 74 + brow}, {50, 11, 56}, 8, 7));
    ridge = smoothUnion(ridge, ellipsoid(p, {0, 13, 74 + brow}, {16, 10, 11}), 8);
    return smoothUnion(d, ridge, 14);
}

float FaceShape::withChin(float d, const Point& p) const {
    const float z = 66 + parameters_.chin_mm;
    d = smoothUnion(d, ellipsoid(p, {0, -97, z}, {19, 15, 18}), 14);
    const Point fold = mirrored(p);
    return smoothCut(d, taperedCapsule(fold, {0, -83.5f, 95}, {14, -83, 90}, 6.5f, 5), 8);
}

float FaceShape::withEyeSocket(float d, const Point& p) const {
    const Point m = mirrored(p);
    const Point& eye = at_.eye;
    if ((m - eye).norm() > 45) return d;
    d = smoothCut(d, ellipsoid(m, eye + Point(-1, -1, 25), {20, 13, 17}), 14);
    const float lid_radius = kEyeRadius + 1.3f;
    float lids = sphere(m, eye, lid_radius);
    // The fold of the upper lid: a fuller brow above, a crease between.
    const Point fold = eye + Point(1, 10.2f, 9.2f);
    const float upper = std::min(taperedCapsule(m, eye + Point(-13, 8, 6), fold, 3, 5),
                                 taperedCapsule(m, fold, eye + Point(17, 6, 0), 5, 3));
    lids = smoothUnion(lids, upper, 4);
    const float lower =
        taperedCapsule(m, eye + Point(-8, -10.5f, 6), eye + Point(9, -10, 5), 3.5f, 3.5f);
    lids = smoothUnion(lids, lower, 8);
    d = smoothUnion(d, lids, 7);
    return m.z() > eye.z() ? smoothCut(d, eyelids(p), 1.2f) : d;
}

float FaceShape::eyelids(const Point& p) const {
    const Point q = mirrored(p) - at_.eye;
    // An almond: two arcs through the corners of the eye, the outer a little higher.
    const float half_width = 14.3f, upper = 4.9f * parameters_.eye_opening, lower = 4.3f;
    const auto arc = [&](float height, float sign) {
        const float radius = (half_width * half_width + height * height) / (2 * height);
        const float dx = q.x() + 0.5f, dy = q.y() - 0.09f * q.x() + 0.5f - sign * (height - radius);
        return std::hypot(dx, dy) - radius;
    };
    return std::max(arc(upper, 1), arc(lower, -1));
}

Point FaceShape::eye(const Point& p) const {
    return {std::copysign(at_.eye.x(), p.x()), at_.eye.y(), at_.eye.z()};
}

float FaceShape::eyeball(const Point& p) const {
    const Point centre = eye(p);
    const float cornea = sphere(p, centre + Point(0, 0, 5.6f), 7.4f);
    return smoothUnion(sphere(p, centre, kEyeRadius), cornea, 1.5f);
}

float FaceShape::withNose(float d, const Point& p) const {
    const Point& tip = at_.nose_tip;
    if ((p - tip).norm() > 75) return d;
    const Point m = mirrored(p);
    const float bridge_mm = parameters_.nose_bridge_mm;
    const Point middle = (at_.nose_root + tip) / 2 + Point(0, 2, 0.5f + bridge_mm);
    float nose = std::min(taperedCapsule(p, at_.nose_root, middle, 6.2f, 6.6f),
                          taperedCapsule(p, middle, tip, 6.6f, 7.4f));
    const float w = parameters_.nose_width;
    nose = smoothUnion(nose, ellipsoid(p, {0, -22, 78}, {12 * w, 30, 14}), 9);
    nose = smoothUnion(nose, ellipsoid(p, tip + Point(0, 1, -12), {11.5f * w, 10, 12}), 6);
    nose = smoothUnion(nose, sphere(m, tip + Point(2.4f, 0, 0.4f), 7.3f), 7);
    nose = smoothUnion(nose, ellipsoid(m, at_.ala, {6.0f, 6.2f, 8.5f}), 7);
    nose = smoothUnion(
        nose, taperedCapsule(p, tip + Point(0, -6.5f, -4), tip + Point(0, -9, -14), 3.6f, 4), 4);
    d = smoothUnion(d, nose, 7);
    const Point nostril = {6.0f * w, at_.ala.y() - 6.2f, at_.ala.z() + 3};
    return smoothCut(d, ellipsoid(m, nostril, {3.0f * w, 5.5f, 5.0f}), 1.8f);
}

/// Straightens the dental arch: the lips lie on a plane there, mirrored to x ≥ 0.
Point FaceShape::lipSpace(const Point& p) const {
    const float x = std::abs(p.x()) / at_.lip_half_width * 24.5f;
    return {x, p.y(), p.z() + 0.0135f * x * x};
}

float FaceShape::lips(const Point& p) const {
    const Point q = lipSpace(p);
    const float full = parameters_.lip_fullness;
    // The mouth's line: a shallow bow, up at the philtrum's sides, its corners a little down.
    const float line = -67.3f - 0.0016f * q.x() * q.x();
    const float lean = q.x() / 24.5f;
    const float thin = std::sqrt(std::max(0.0f, 1 - 0.92f * lean * lean));
    const Point upper = {q.x(), q.y() - line, q.z()};
    const float bow = ellipsoid(upper, {6.5f, 2.4f * thin, 84.5f}, {18.5f, 4.2f * full, 6.5f});
    const float dip = ellipsoid(upper, {0, 1.8f, 84.8f}, {7, 3.4f * full, 6.3f});
    const float lower = ellipsoid(upper, {0, -4.0f * thin, 84.0f}, {21.5f, 5.3f * full, 7.2f});
    return smoothUnion(std::min(bow, dip), lower, 4);
}

float FaceShape::withMouth(float d, const Point& p) const {
    if ((p - Point(0, -68, 80)).norm() > 60) return d;
    d = smoothUnion(d, ellipsoid(p, {0, -67, 62}, {33, 26, 24}), 16);
    d = smoothCut(d, taperedCapsule(p, {0, -52, 91}, {0, -61, 93}, 2.6f, 3.0f), 4);
    d = smoothUnion(d, lips(p), 3);
    const Point q = lipSpace(p);
    const float line = -67.3f - 0.0016f * q.x() * q.x();
    const float bow = 0.5f * std::cos(q.x() * 0.28f);
    const Point off_slit = {std::max(0.0f, q.x() - 20.5f), q.y() - line + bow,
                            std::max(0.0f, 86 + 0.01f * q.x() * q.x() - q.z())};
    return smoothCut(d, off_slit.norm() - 0.7f, 1.8f);
}

float FaceShape::neck(const Point& p) const {
    const Point m = mirrored(p);
    float d = taperedCapsule(p, {0, -60, -24}, {0, -200, -36}, 52, 56);
    d = smoothUnion(d, sphere(p, {0, -142, 18}, 9), 12);
    d = smoothUnion(d, taperedCapsule(m, {18, -178, -40}, {150, -226, -48}, 34, 40), 30);
    return smoothUnion(d, taperedCapsule(m, {4, -186, 20}, {90, -176, -16}, 7, 6), 14);
}

float FaceShape::withEar(float d, const Point& p) const {
    const Point m = mirrored(p) - Point(73, -6, -8);
    if (m.norm() > 60) return d;
    const Point q = turnedAboutY(m, 0.5f);
    const Point tilted = {q.x(), q.y(), q.z() + 0.15f * q.y()};
    float ear = ellipsoid(tilted, {3, 0, -6}, {4.5f, 31, 17});
    ear = smoothCut(ear, ellipsoid(tilted, {8, 3, -6}, {4.0f, 23, 11}), 3);
    ear = smoothUnion(ear, ellipsoid(tilted, {3, -22, -3}, {4, 9, 8}), 3);
    return smoothUnion(d, ear, 5);
}

float FaceShape::hair(const Point& p) const {
    const bool is_long = parameters_.hair == HairStyle::long_hair;
    const float thick = is_long ? 10.0f : 6.0f;
    float d = ellipsoid(p, {0, 24, -10}, {74 + thick, 90 + thick, 92 + thick});
    // The hairline: over the forehead, back at the temples, down before the ears.
    const float side = std::abs(p.x()) / 70;
    const float hairline = 69 + parameters_.hairline_mm - 22 * side * side;
    const float bare = (hairline - p.y()) * 0.72f + (p.z() - 62) * 0.55f;
    if (std::abs(bare) < 15) {
        const float uneven = 3.5f * fractalNoise(p * 0.1f, 3, parameters_.seed + 30);
        d = smoothIntersection(d, bare - uneven, 9);
    } else {
        d = std::max(d, bare);
    }
    if (is_long) {
        float curtain = ellipsoid(p, {0, -30, -38}, {95, 140, 62});
        d = smoothUnion(d, curtain, 10);
    }
    if (d > 6) return d;
    // Strands run down the head: noise drawn out along y and z.
    const Point strand = {p.x() * 0.5f, p.y() * 0.06f, p.z() * 0.12f};
    return d + 1.4f * fractalNoise(strand, 3, parameters_.seed + 20);
}

float FaceShape::beardCover(const Point& p) const {
    if (parameters_.beard == Beard::none || p.z() < 0) return 0;
    const float x = std::abs(p.x());
    // From the sideburns along the jaw, over the chin, and the moustache; bare cheeks and lips.
    const float cheek_line = -48 - 0.55f * std::max(0.0f, 50 - x) + 0.012f * x * x;
    const float jaw = std::clamp((cheek_line - p.y()) / 12, 0.0f, 1.0f);
    const float moustache_y = -56 - 0.08f * x;
    const float moustache = std::clamp((moustache_y - p.y()) / 2.5f, 0.0f, 1.0f) *
                            std::clamp((31 - x) / 5, 0.0f, 1.0f) * (p.y() > -95 ? 1.0f : 0.0f);
    const float below_chin = std::clamp((p.y() + 124) / 12, 0.0f, 1.0f);
    const float bare_lips = std::clamp((lips(p) - 1.0f) / 4, 0.0f, 1.0f);
    return std::max(jaw, moustache) * below_chin * bare_lips;
}

}  // namespace facescan::sim
