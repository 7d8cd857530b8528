#include "sim/face_parameters.h"

#include <algorithm>
#include <cmath>

#include "sim/random.h"

namespace facescan::sim {

FaceParameters FaceParameters::fromSeed(std::uint64_t seed) {
    FaceParameters face;
    face.seed = seed;
    if (seed == 0) return face;

    std::uint64_t draw = 0;
    const auto range = [&](double low, double high) {
        return float(uniform(hashed(seed, ++draw), low, high));
    };
    const auto about = [&](double mean, double deviation) {
        return float(mean + deviation * std::clamp(gaussian(hashed(seed, ++draw)), -2.0, 2.0));
    };
    face.width = about(1, 0.035);
    face.length = about(1, 0.035);
    face.jaw_width = about(1, 0.07);
    face.cheekbones = about(1, 0.25);
    face.brow_ridge = about(1, 0.3);
    face.eye_spacing = about(1, 0.03);
    face.eye_opening = about(1, 0.1);
    face.nose_length = about(1, 0.06);
    face.nose_width = about(1, 0.12);
    face.nose_height = about(1, 0.12);
    face.nose_bridge_mm = about(0, 1.2);
    face.mouth_width = about(1, 0.06);
    face.lip_fullness = about(1, 0.2);
    face.chin_mm = about(0, 2);
    face.asymmetry_mm = about(0, 0.8);

    // Even steps in the logarithm: as many dark faces as light ones.
    face.skin_albedo = std::exp(range(std::log(0.07), std::log(0.62)));
    const float darkest = 0.03f;
    face.hair_albedo = range(darkest, face.skin_albedo > 0.35f ? 0.3 : 0.07);
    face.iris_albedo = range(0.05, face.skin_albedo > 0.35f ? 0.3 : 0.1);
    face.hairline_mm = about(0, 5);
    const float style = range(0, 1);
    face.hair = style < 0.15f   ? HairStyle::bald
                : style < 0.65f ? HairStyle::short_hair
                                : HairStyle::long_hair;
    const float beard = range(0, 1);
    if (face.hair != HairStyle::long_hair) {
        face.beard = beard < 0.5f ? Beard::none : beard < 0.75f ? Beard::stubble : Beard::full;
    }

    face.yaw_deg = about(0, 5);
    face.pitch_deg = about(0, 4);
    face.roll_deg = about(0, 3);
    face.nose_distance_mm = range(370, 395);
    face.offset_x_mm = about(0, 4);
    face.offset_y_mm = about(0, 5);
    return face;
}

}  // namespace facescan::sim
