#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// The usual distance between neighbouring stripe edges of one column, px: the median over the
/// grid; 0 where there are none. `scratch` is scratch memory.
float medianStripeWidth(const VertexGrid& grid, std::vector<float>& scratch);

/// Scratch memory of rejectFalseEdges.
struct FilterScratch {
    std::vector<float> widths;
    std::vector<std::uint32_t> component;
    std::vector<std::uint32_t> component_size;
};

/// Empties the cells that are no part of a surface (decoding constraints, thesis section 3.8):
/// those without two neighbours that continue them, and pieces too small to be a part of a face.
/// Marks the ends of the surfaces that stay.
///
/// @param rising  whether the code rises with y
/// @returns the number of cells emptied
int rejectFalseEdges(const Options& options, bool rising, FilterScratch& scratch, VertexGrid& grid);

}  // namespace facescan
