#pragma once

#include <cstdint>

namespace facescan::sim {

/// The image sensor: grey = pedestal + gain · radiance, plus noise, rounded to 0 … 255.
struct Sensor {
    double gain = 265;                ///< grey levels for a white surface that faces the projector
    double pedestal = 2;              ///< grey levels of a black pixel
    double electrons_per_level = 40;  ///< shot noise; 0: none
    double read_noise_levels = 1;     ///< standard deviation
};

/// The noise-free grey level, not rounded, not saturated.
inline double expectedGrey(const Sensor& sensor, double radiance) {
    return sensor.pedestal + sensor.gain * radiance;
}

/// The variance of the noise at an expected grey level: signal / electrons + read noise².
double noiseVariance(const Sensor& sensor, double expected);

/// What the sensor reports for an expected grey level; `bits` are random.
std::uint8_t expose(const Sensor& sensor, double expected, std::uint64_t bits);

}  // namespace facescan::sim
