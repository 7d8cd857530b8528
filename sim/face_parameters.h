#pragma once

#include <cstdint>

namespace facescan::sim {

enum class HairStyle { bald, short_hair, long_hair };
enum class Beard { none, stubble, full };

/// What tells one face from another. Ratios are of an average adult's; the defaults are that.
struct FaceParameters {
    std::uint64_t seed = 0;  ///< of skin texture and hair

    float width = 1;   ///< of head and face
    float length = 1;  ///< eyes to chin
    float jaw_width = 1;
    float cheekbones = 1;  ///< prominence
    float brow_ridge = 1;  ///< prominence
    float eye_spacing = 1;
    float eye_opening = 1;
    float nose_length = 1;
    float nose_width = 1;
    float nose_height = 1;     ///< of its tip over the cheeks
    float nose_bridge_mm = 0;  ///< a hump (above 0) or a saddle
    float mouth_width = 1;
    float lip_fullness = 1;
    float chin_mm = 0;       ///< forward
    float asymmetry_mm = 0;  ///< the lower face leans sideways by this at the chin

    float skin_albedo = 0.5f;  ///< 0.06 very dark … 0.65 light
    float hair_albedo = 0.08f;
    float iris_albedo = 0.15f;
    float hairline_mm = 0;  ///< upwards: receding
    HairStyle hair = HairStyle::short_hair;
    Beard beard = Beard::none;

    double yaw_deg = 0;             ///< the face turns to the image's right
    double pitch_deg = 0;           ///< the face looks up
    double roll_deg = 0;            ///< the head leans clockwise in the image
    double nose_distance_mm = 380;  ///< depth of the tip of the nose
    double offset_x_mm = 0;         ///< to the image's right
    double offset_y_mm = 0;         ///< downwards

    /// A person for every seed; the same for the same seed. Seed 0 is the average of the defaults.
    static FaceParameters fromSeed(std::uint64_t seed);
};

}  // namespace facescan::sim
