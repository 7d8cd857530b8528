#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "sim/scene.h"

namespace facescan::sim {

/// The points origin + t · direction for t in (near, far).
struct Ray {
    Eigen::Vector3f origin;
    Eigen::Vector3f direction;
    float near = 0;
    float far = std::numeric_limits<float>::infinity();
};

/// Where a ray first meets the scene.
struct Hit {
    enum class Target : std::uint8_t { nothing, surface, backdrop };
    Target target = Target::nothing;
    std::uint32_t triangle = 0;  ///< of the surface
    float t = 0;
    float u = 0;  ///< weight of the triangle's second vertex
    float v = 0;  ///< weight of the third
};

/// Finds what rays meet. Keeps a reference to the scene. Its const functions may be called from
/// several threads.
class RayCaster {
public:
    explicit RayCaster(const Scene& scene);
    ~RayCaster();

    /// hits[i] is where rays[i] first meets the scene. Neighbouring rays should lie close together.
    void closest(std::span<const Ray> rays, std::span<Hit> hits) const;

    /// blocked[i] is 1 where anything lies on rays[i], otherwise 0.
    void blocked(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
};

}  // namespace facescan::sim
