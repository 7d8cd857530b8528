#pragma once

#include <array>
#include <vector>

#include "reconstruct/vertex_grid.h"

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

/// The weights of a window's cells, row after row, that give the value in its middle of the
/// quadratic in code and column fitted to them all (Savitzky & Golay 1964).
const std::vector<float>& fixedWeights(int window);

struct RobustFit {
    float y;
    bool consistent;  ///< whether the cell itself lies on the fitted surface
};

/// The quadratic through the measured cells around a cell, at the cell: reweighted by Tukey's
/// biweight with a cut-off that shrinks to `cutoff`, unweighted where nothing stands out.
///
/// @param window      index into kWindows
/// @param half_codes  at most the window's; 0 for the cell's own row alone
/// @param cutoff      px; a cell farther than this from the surface is not consistent with it
RobustFit robustFit(const VertexGrid& grid, int window, int code, int column, float cutoff,
                    int half_codes);

}  // namespace facescan
