#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/kernels/kernels.h"
#include "reconstruct/vertex_grid.h"
#include "reconstruct/window.h"

namespace facescan {

/// The weights of a window's cells that give the value in its middle of the quadratic in code and
/// column fitted to them all (Savitzky & Golay 1964).
const FixedFilter& fixedFilter(int window);

/// The measured edges of a grid with a margin as wide as the widest window, so that a window at the
/// border is like any other.
struct FitPlanes {
    std::ptrdiff_t stride = 0;    ///< from one code to the next
    std::vector<float> y;         ///< px; 0 where nothing is measured
    std::vector<float> present;   ///< 1 where an edge is measured, else 0
    std::vector<Extent> written;  ///< by code: outside, y and present are 0

    void assign(const VertexGrid& grid);
    std::ptrdiff_t index(int code, int column) const;
};

/// A cell whose surface is asked for.
struct FitRequest {
    std::uint16_t code;
    std::uint16_t column;
    float cutoff;  ///< px; farther than this from the surface the cell is not consistent with it
};

struct RobustFit {
    float y;
    bool consistent;  ///< whether the cell itself lies on the fitted surface
};

/// The quadratics through the measured cells around some cells, at these cells: reweighted once by
/// Tukey's biweight, with 1.5 times the request's cut-off, unless nothing stands out. Where a cell
/// is not consistent, its y is as it was.
///
/// @param window      index into kWindows
/// @param half_codes  at most the window's; 0 for the cell's own row alone
/// @param requests    row after row, each from left to right
/// @param fits        one for each request
void robustFits(const FitPlanes& planes, int window, int half_codes,
                std::span<const FitRequest> requests, std::span<RobustFit> fits);

}  // namespace facescan
