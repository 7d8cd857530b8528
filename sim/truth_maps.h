#pragma once

#include <cstdint>
#include <vector>

#include "sim/device.h"
#include "sim/ray_caster.h"
#include "sim/scene.h"

namespace facescan::sim {

/// The exact answer for one frame, a value a pixel, in the scanner's frame at that moment. All but
/// `hit` and `lit` hold for the pixel's centre.
struct TruthMaps {
    int frame = 0;
    std::vector<float> z;         ///< depth, mm; NaN where nothing is seen
    std::vector<float> cos_cam;   ///< cosine between the surface's normal and the way to the camera
    std::vector<float> cos_proj;  ///< … and the way to the projector; below 0: turned away
    std::vector<std::uint8_t> inside;  ///< 1: in the projector's picture, a stripe from its border
    std::vector<std::uint8_t> hit;     ///< 16ths of the pixel that see the surface
    std::vector<std::uint8_t> lit;     ///< 16ths that see a point which the projector reaches
};

/// The maps that hold for pixel centres; `hit` and `lit` stay 0.
TruthMaps castTruthMaps(const RayCaster& caster, const Scene& scene, const Device& device,
                        int stripes, const Pose& pose, int frame, int threads);

}  // namespace facescan::sim
