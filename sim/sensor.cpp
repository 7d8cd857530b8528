#include "sim/sensor.h"

#include <algorithm>
#include <cmath>

#include "sim/random.h"

namespace facescan::sim {

double noiseVariance(const Sensor& sensor, double expected) {
    const double signal = std::max(0.0, expected - sensor.pedestal);
    const double shot = sensor.electrons_per_level > 0 ? signal / sensor.electrons_per_level : 0;
    return shot + sensor.read_noise_levels * sensor.read_noise_levels;
}

std::uint8_t expose(const Sensor& sensor, double expected, std::uint64_t bits) {
    const double noisy = expected + std::sqrt(noiseVariance(sensor, expected)) * gaussian(bits);
    return std::uint8_t(std::clamp(std::floor(noisy + 0.5), 0.0, 255.0));
}

}  // namespace facescan::sim
