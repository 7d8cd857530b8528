#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/kernels/kernels.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// How the quads of a vertex grid are cut into triangles. A quad stands at its north-west cell,
/// north at the lower code and west at the lower column:
///
///     nw --- ne
///      |     |
///     sw --- se
///
/// It is cut along nw–se (falling) or ne–sw. Of its two triangles, "first" is the one with the
/// north edge. A quad of three cells is cut so that they form one of the two.
struct Quads {
    std::vector<std::uint8_t> first;    ///< by cell: 1 where the quad has this triangle
    std::vector<std::uint8_t> second;   ///< likewise
    std::vector<std::uint8_t> falling;  ///< 1 where the cut falls

    QuadFlags from(std::size_t i) const { return {&first[i], &second[i], &falling[i]}; }
};

/// The quads of a row of cells, and the row south of it, outside which there is none.
inline Extent quadExtent(const VertexGrid& grid, int code) {
    if (code < 1 || code + 1 >= grid.codes) return {0, 0};
    const Extent& north = grid.extent[code];
    const Extent& south = grid.extent[code + 1];
    const int first = north.first < south.first ? north.first : south.first;
    const int end = (north.end > south.end ? north.end : south.end) - 1;
    return first < end ? Extent{first, end} : Extent{0, 0};
}

}  // namespace facescan
