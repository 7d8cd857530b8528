#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

/// Counter-based random numbers: each is a function of what it is for, so that the order in which
/// they are drawn, and the number of threads, change nothing.
namespace facescan::sim {

/// Mixes up to three numbers into 64 evenly distributed bits (the finaliser of SplitMix64).
constexpr std::uint64_t hashed(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) {
    std::uint64_t h = 0x9e3779b97f4a7c15;
    for (const std::uint64_t value : {a, b, c}) {
        h += value + 0x9e3779b97f4a7c15;
        h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9;
        h = (h ^ (h >> 27)) * 0x94d049bb133111eb;
        h ^= h >> 31;
    }
    return h;
}

/// Uniform in the open interval (0, 1).
constexpr double uniform(std::uint64_t bits) {
    return (double(bits >> 12) + 0.5) * 0x1p-52;
}

/// Uniform in (low, high).
constexpr double uniform(std::uint64_t bits, double low, double high) {
    return low + (high - low) * uniform(bits);
}

/// The share of a standard normal distribution below x.
inline float normalShareBelow(float x) {
    return 0.5f * std::erfc(x * -0.70710678f);
}

/// The standard normal quantile of `p` in (0, 1), to 1e-9 (relative).
/// Source: P. J. Acklam's rational approximation, one step of Halley's method left out.
double normalQuantile(double p);

/// Standard normal.
inline double gaussian(std::uint64_t bits) {
    return normalQuantile(uniform(bits));
}

}  // namespace facescan::sim
