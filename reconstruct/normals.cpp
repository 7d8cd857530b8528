#include "reconstruct/normals.h"

#include <algorithm>

namespace facescan {
namespace {

/// Before the quad of the first column stands one without triangles.
constexpr int kMargin = 1;

VertexCorners::Side sideFrom(const NormalScratch::Row& row, int column) {
    const std::size_t i = std::size_t(column) + kMargin;
    return {rowFrom(row.first, i), rowFrom(row.second, i), row.falling.data() + i};
}

}  // namespace

void computeNormals(const VertexGrid& grid, const PointPlanes& points, const Quads& quads,
                    float side, NormalScratch& scratch, PointPlanes& normals) {
    normals.resize(grid.size() + VertexGrid::kBeyond);
    for (NormalScratch::Row& row : scratch.rows) {
        for (PointPlanes* planes : {&row.first, &row.second}) {
            planes->clear(std::size_t(grid.columns) + kMargin);
        }
        row.falling.assign(std::size_t(grid.columns) + kMargin, 0);
    }
    for (int code = 1; code < grid.codes; ++code) {
        NormalScratch::Row& south = scratch.rows[code % 2];
        const NormalScratch::Row& north = scratch.rows[(code + 1) % 2];
        for (PointPlanes* planes : {&south.first, &south.second}) {
            planes->clear(std::size_t(grid.columns) + kMargin);
        }
        const Extent quad = quadExtent(grid, code);
        if (quad.first < quad.end) {
            const std::size_t i = grid.index(code, quad.first);
            const std::size_t next = i + grid.columns;
            const std::size_t to = std::size_t(quad.first) + kMargin;
            kernels().triangleNormals(
                {rowFrom(points, i), rowFrom(points, next), nullptr, nullptr, nullptr, nullptr},
                quads.from(i), quad.end - quad.first,
                {rowFrom(south.first, to), rowFrom(south.second, to)});
            std::copy_n(&quads.falling[i], quad.end - quad.first, &south.falling[to]);
        }
        const auto [first, end] = grid.extent[code];
        if (first >= end) continue;
        kernels().vertexNormals({sideFrom(south, first), sideFrom(north, first)}, side, end - first,
                                rowFrom(normals, grid.index(code, first)));
    }
}

}  // namespace facescan
