#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/vertex_grid.h"
#include "reconstruct/window_fit.h"

namespace facescan {

/// The noise of the edge positions, before smoothing.
struct EdgeNoise {
    /// Standard deviation of pattern − complement where an edge was located, grey levels: an edge
    /// of contrast g (grey levels per px) is off by grey_levels / g pixels.
    float grey_levels = 0;

    float pixels(float contrast) const { return contrast > 0 ? grey_levels / contrast : 0.0f; }
};

/// Measures the noise from third differences across the stripes: neighbouring edges of a column
/// come from different frames and rows, so that their noise is independent, and a smooth surface
/// leaves no third difference. The median makes it blind to creases and steps.
EdgeNoise estimateNoise(const VertexGrid& grid, std::vector<float>& scratch);

/// Scratch memory of smoothEdges.
struct SmoothScratch {
    std::vector<std::uint8_t> measured;
    std::vector<std::uint8_t> regular;
    std::array<std::vector<std::uint8_t>, kWindows.size()> covered;  ///< by window
    // Of one row.
    std::vector<std::uint8_t> row;
    std::vector<std::uint8_t> window_of;
    std::array<std::vector<std::uint8_t>, kWindows.size()> wanted;
    std::array<std::vector<float>, 2> column_sums;

    std::array<std::vector<FitRequest>, kWindows.size()> irregular;  ///< by window
    FitPlanes planes;
    std::vector<FitRequest> own_row;
    std::vector<RobustFit> fits;
};

/// Smooths the edge positions by local quadratic fits on the grid, before calibration, where a
/// vertex is one number with regular neighbours. The window grows with the vertex' noise. Inside a
/// surface the fit is a fixed filter (Savitzky & Golay 1964); beside holes, creases and outliers it
/// is reweighted by Tukey's biweight, so that the far side of an edge has no say.
///
/// A vertex that its neighbours' surface contradicts is emptied: it is a false measurement.
/// @returns the number of cells emptied
int smoothEdges(const Options& options, const EdgeNoise& noise, SmoothScratch& scratch,
                VertexGrid& grid);

}  // namespace facescan
