#pragma once

#include <cstddef>

#include "reconstruct/vertex_grid.h"

namespace facescan {

/// Calls visit(index) with some thousand of the measured cells, which tell a median or a mean as
/// well as all: along diagonals, so that every column has its samples, row after row.
/// @param rows  only cells with so many rows below them
template <typename Visit>
void forEachSample(const VertexGrid& grid, int rows, Visit visit) {
    constexpr std::size_t kEnough = 16000;  // cells, measured or not
    const int step = 1 + int(grid.size() / kEnough);
    for (int code = 1; code + rows < grid.codes; ++code) {
        const Extent& extent = grid.extent[code];
        for (int column = extent.first + code % step; column < extent.end; column += step) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::measured) visit(i);
        }
    }
}

}  // namespace facescan
