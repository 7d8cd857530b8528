#include "reconstruct/lay_mesh.h"

#include <algorithm>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"

namespace facescan {
namespace {

/// Marks the cells of a row that a triangle uses: those of the quads to the south and to the north.
/// @returns how many
FACESCAN_KERNEL int markUsed(const QuadFlags& south, const QuadFlags& north, int first, int end,
                             std::uint8_t* __restrict used) {
    const std::uint8_t* __restrict a = south.first;
    const std::uint8_t* __restrict b = south.second;
    const std::uint8_t* __restrict falling = south.falling;
    const std::uint8_t* __restrict north_a = north.first;
    const std::uint8_t* __restrict north_b = north.second;
    const std::uint8_t* __restrict north_falling = north.falling;
    // As the north-west and the south-west corner.
#pragma GCC ivdep
    for (int x = first; x < end; ++x) {
        const std::uint8_t rises = north_falling[x] ^ 1;
        used[x] = std::uint8_t(a[x] | (b[x] & falling[x]) | north_b[x] | (north_a[x] & rises));
    }
    // As the north-east and the south-east corner.
#pragma GCC ivdep
    for (int x = std::max(first, 1); x < end; ++x) {
        const std::uint8_t rises = falling[x - 1] ^ 1;
        used[x] |= std::uint8_t(a[x - 1] | (b[x - 1] & rises) | north_b[x - 1] |
                                (north_a[x - 1] & north_falling[x - 1]));
    }
    int count = 0;
    for (int x = first; x < end; ++x) count += used[x];
    return count;
}

int countTriangles(const VertexGrid& grid, const Quads& quads, int code) {
    const Extent quad = quadExtent(grid, code);
    const std::size_t row = grid.index(code, 0);
    int count = 0;
    for (int x = quad.first; x < quad.end; ++x)
        count += quads.first[row + x] + quads.second[row + x];
    return count;
}

/// Says where the camera sees an edge in the texture.
class TexturePlace {
public:
    explicit TexturePlace(const ScanDescription& scan)
        : turned_(scan.pattern.axis == CodeAxis::x),
          per_width_(1.0f / float(scan.image.width)),
          per_height_(1.0f / float(scan.image.height)) {}

    void set(int column, float y, Vertex& vertex) const {
        const float across = float(column) + 0.5f;
        const float along = y + 0.5f;
        vertex.s = (turned_ ? along : across) * per_width_;
        vertex.t = 1.0f - (turned_ ? across : along) * per_height_;
    }

private:
    bool turned_;
    float per_width_;
    float per_height_;
};

}  // namespace

void layMesh(const ScanDescription& scan, const VertexGrid& grid, const PointPlanes& points,
             const PointPlanes& normals, const Quads& quads, bool rising, const EdgeNoise& noise,
             LayMeshScratch& scratch, Mesh& mesh) {
    const TexturePlace texture(scan);
    const bool swap = turnsClockwise(scan.pattern, rising);
    scratch.used.resize(grid.size());
    scratch.quality.resize(grid.columns);
    for (std::vector<std::uint32_t>& row : scratch.vertex) row.resize(grid.columns);
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (int code = 1; code < grid.codes; ++code) {
        // The quads of row 0 are empty.
        const auto [first, end] = grid.extent[code];
        const std::size_t row = grid.index(code, 0);
        vertices += markUsed(quads.from(row), quads.from(row - grid.columns), first, end,
                             scratch.used.data() + row);
        triangles += countTriangles(grid, quads, code);
    }
    mesh.vertices.resize(vertices);
    mesh.triangles.resize(triangles);
    Vertex* vertex = mesh.vertices.data();
    Triangle* triangle = mesh.triangles.data();
    const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        *triangle++ = swap ? Triangle{a, c, b} : Triangle{a, b, c};
    };

    for (int code = 1; code < grid.codes; ++code) {
        const auto [first, end] = grid.extent[code];
        std::uint32_t* index = scratch.vertex[code % 2].data();
        if (first < end) {
            const std::size_t row = grid.index(code, 0);
            kernels().vertexQuality(&grid.contrast[row + first], noise.grey_levels, end - first,
                                    scratch.quality.data());
            for (int x = first; x < end; ++x) {
                const std::size_t i = row + x;
                if (!scratch.used[i]) continue;
                index[x] = std::uint32_t(vertex - mesh.vertices.data());
                vertex->x = points.x[i];
                vertex->y = points.y[i];
                vertex->z = points.z[i];
                vertex->nx = normals.x[i];
                vertex->ny = normals.y[i];
                vertex->nz = normals.z[i];
                texture.set(x, grid.y[i], *vertex);
                vertex->quality = grid.cell[i] == Cell::filled ? 0.0f : scratch.quality[x - first];
                ++vertex;
            }
        }
        const Extent quad = quadExtent(grid, code - 1);
        const std::uint32_t* north = scratch.vertex[(code + 1) % 2].data();
        const std::size_t row = grid.index(code - 1, 0);
        for (int x = quad.first; x < quad.end; ++x) {
            const bool has_first = quads.first[row + x];
            const bool has_second = quads.second[row + x];
            if (!has_first && !has_second) continue;
            const bool falling = quads.falling[row + x];
            if (has_first) addTriangle(north[x], north[x + 1], falling ? index[x + 1] : index[x]);
            if (has_second) addTriangle(falling ? north[x] : north[x + 1], index[x + 1], index[x]);
        }
    }
}

}  // namespace facescan
