#include "sim/noise_field.h"

#include <cmath>

#include "sim/random.h"

namespace facescan::sim {

namespace {

float latticeValue(int x, int y, int z, std::uint64_t seed) {
    const std::uint64_t cell = (std::uint64_t(std::uint32_t(x)) << 32) | std::uint32_t(y);
    return float(hashed(seed, cell, std::uint32_t(z)) >> 40) * 0x1p-23f - 1.0f;
}

float mixed(float a, float b, float t) {
    return a + (b - a) * t;
}

}  // namespace

float valueNoise(const Eigen::Vector3f& p, std::uint64_t seed) {
    const Eigen::Vector3f floor = p.array().floor();
    const Eigen::Vector3f f = p - floor;
    const Eigen::Vector3f t = f.array().square() * (3 - 2 * f.array());
    const int x = int(floor.x()), y = int(floor.y()), z = int(floor.z());
    const auto along_x = [&](int dy, int dz) {
        return mixed(latticeValue(x, y + dy, z + dz, seed),
                     latticeValue(x + 1, y + dy, z + dz, seed), t.x());
    };
    return mixed(mixed(along_x(0, 0), along_x(1, 0), t.y()),
                 mixed(along_x(0, 1), along_x(1, 1), t.y()), t.z());
}

float fractalNoise(Eigen::Vector3f p, int octaves, std::uint64_t seed) {
    float sum = 0, weight = 0.5f;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * valueNoise(p, seed + octave);
        p *= 2;
        weight *= 0.5f;
    }
    return sum * 1.3f;
}

}  // namespace facescan::sim
