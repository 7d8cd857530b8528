#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/device.h"
#include "sim/ray_caster.h"
#include "sim/scene.h"

namespace facescan::sim {

/// Full-width rows of the camera's image, sampled on a lattice of per_side² points a pixel, with
/// `margin_px` pixels more on every side.
struct SampleWindow {
    int first_row = 0;
    int rows = 0;
    int margin_px = 0;
    int per_side = 1;

    int sampleRows() const { return (rows + 2 * margin_px) * per_side; }
    int sampleColumns(int width) const { return (width + 2 * margin_px) * per_side; }
};

/// What a sample sees, whatever the projector shows: its radiance is
/// `ambient + direct · Σ weights[i] · brightness of stripe (first_stripe + i)`.
struct Sample {
    float ambient = 0;
    float direct = 0;
    std::int32_t first_stripe = 0;
    std::uint32_t first_weight = 0;
    std::uint8_t weight_count = 0;
    bool hit = false;  ///< sees the surface
    bool lit = false;  ///< sees a point that the projector's light reaches
};

struct SampleBand {
    std::vector<Sample> samples;  ///< row by row
    std::vector<float> weights;
};

/// The viewing rays (at Z = 1) of a window's samples.
std::vector<Eigen::Vector3f> viewingRays(const Camera& camera, const SampleWindow& window);

/// Casts the rays of a window from the scanner at `pose`, and from what they meet to the projector.
/// @param stripes  of the pattern
SampleBand trace(const RayCaster& caster, const Scene& scene, const Device& device, int stripes,
                 const Pose& pose, std::span<const Eigen::Vector3f> viewing, int columns);

/// The radiance of every sample while the projector shows `picture`: one brightness a stripe.
void illuminate(const SampleBand& band, std::span<const float> picture, std::span<float> radiance);

}  // namespace facescan::sim
