#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace facescan::sim {

/// Smooth random values in space: −1 … 1, features about 1 apart, by interpolating a hashed
/// lattice.
float valueNoise(const Eigen::Vector3f& p, std::uint64_t seed);

/// Value noise summed over `octaves`, each twice as fine and half as strong; about −1 … 1.
float fractalNoise(Eigen::Vector3f p, int octaves, std::uint64_t seed);

}  // namespace facescan::sim
