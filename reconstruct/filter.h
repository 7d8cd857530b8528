#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// The usual distance between neighbouring stripe edges of one column, px: the median over the
/// grid; 0 where there are none. `scratch` is scratch memory.
float medianStripeWidth(const VertexGrid& grid, std::vector<float>& scratch);

/// Cells of a row that continue each other, from the first to the last, perhaps with small gaps.
struct SurfaceRun {
    int code;
    int first;
    int last;
    std::uint32_t cells;      ///< of the run; in a root, of its whole piece
    std::uint32_t connected;  ///< a run of the same piece; the root's own index in the root
};

/// Scratch memory of rejectFalseEdges.
struct FilterScratch {
    std::vector<float> widths;
    std::vector<std::uint8_t> measured;  ///< by cell
    std::vector<std::uint8_t> kept;      ///< by cell
    std::vector<std::uint8_t> row;       ///< flags of single rows
    std::vector<SurfaceRun> runs;
    std::array<std::vector<std::uint32_t>, 2> run_of;  ///< by column, in two rows
};

/// Empties the cells that are no part of a surface (decoding constraints, thesis section 3.8):
/// those without two neighbours that continue them, and pieces too small to be a part of a face.
/// Marks the ends of the surfaces that stay.
///
/// @param rising  whether the code rises with y
/// @returns the number of cells emptied
int rejectFalseEdges(const Options& options, bool rising, FilterScratch& scratch, VertexGrid& grid);

}  // namespace facescan
