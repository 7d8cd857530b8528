#pragma once

#include <array>

namespace facescan {

/// The neighbourhood of a local fit: codes −half_codes … half_codes by columns likewise.
struct Window {
    int half_codes;
    int half_columns;
    float max_noise_px;  ///< noise up to which this window serves
};

/// Wider windows average more noise and cost more detail.
inline constexpr std::array<Window, 3> kWindows{{{1, 4, 0.07f}, {2, 5, 0.16f}, {3, 7, 1e9f}}};

/// The narrowest window that serves for a noise.
constexpr int windowFor(float noise_px) {
    int window = 0;
    while (noise_px > kWindows[window].max_noise_px) ++window;
    return window;
}

}  // namespace facescan
