#include "sim/surface_nets.h"

#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "sim/parallel.h"

namespace facescan::sim {

namespace {

using Cell = Eigen::Vector3i;

constexpr int kBlock = 4;             // cells along a block's edge
constexpr int kCorners = kBlock + 1;  // corners along it
constexpr int kCube = 4 * kBlock;     // cells along a cube that is first looked at whole
constexpr float kSlope = 1.5f;        // the steepest that a field may be

struct Grid {
    Eigen::Vector3f origin;
    float cell;

    Eigen::Vector3f corner(const Cell& index) const { return origin + cell * index.cast<float>(); }
};

/// The part of the surface in kBlock³ cells: a vertex for each cell that it crosses.
struct Block {
    Cell first;                                          // its first cell
    std::bitset<kCorners * kCorners * kCorners> inside;  // by corner
    std::vector<Cell> cells;
    std::vector<Eigen::Vector3f> positions;

    static int index(const Cell& c) { return (c.z() * kCorners + c.y()) * kCorners + c.x(); }
};

std::uint64_t key(const Cell& cell) {
    return (std::uint64_t(cell.z()) << 42) | (std::uint64_t(cell.y()) << 21) |
           std::uint64_t(cell.x());
}

Cell unit(int axis) {
    return Cell::Unit(axis);
}

template <typename Visit>
void forEachIn(int count, Visit visit) {
    for (int z = 0; z < count; ++z) {
        for (int y = 0; y < count; ++y) {
            for (int x = 0; x < count; ++x) visit(Cell(x, y, z));
        }
    }
}

/// The field's slope over a cell of the block, from its corners.
Eigen::Vector3f gradient(const std::vector<float>& values, const Cell& cell, float size) {
    Eigen::Vector3f g = Eigen::Vector3f::Zero();
    forEachIn(2, [&](const Cell& corner) {
        const float value = values[Block::index(cell + corner)];
        for (int axis = 0; axis < 3; ++axis) g[axis] += corner[axis] ? value : -value;
    });
    return g / (4 * size);
}

/// Two steps along the slope onto the zero set, each no farther than half a cell.
Eigen::Vector3f ontoSurface(const DistanceField& field, Eigen::Vector3f p,
                            const Eigen::Vector3f& slope, float cell) {
    if (slope.squaredNorm() < 0.01f) return p;
    for (int step = 0; step < 2; ++step) {
        Eigen::Vector3f move = slope * (field(p) / slope.squaredNorm());
        if (move.norm() > 0.5f * cell) move *= 0.5f * cell / move.norm();
        p -= move;
    }
    return p;
}

/// The mean of the places where the surface crosses the edges of a cell of the block; false if
/// it crosses none.
bool crossing(const std::vector<float>& values, const Cell& cell, Eigen::Vector3f& mean) {
    int count = 0;
    mean.setZero();
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 4; ++side) {
            const Cell a =
                cell + (side & 1) * unit((axis + 1) % 3) + (side >> 1) * unit((axis + 2) % 3);
            const float va = values[Block::index(a)], vb = values[Block::index(a + unit(axis))];
            if ((va < 0) == (vb < 0)) continue;
            mean += a.cast<float>() + Eigen::Vector3f::Unit(axis) * (va / (va - vb));
            ++count;
        }
    }
    if (count > 0) mean /= float(count);
    return count > 0;
}

/// Appends the first cells of the blocks inside the cube of `cells` at `first` that the surface may
/// cross.
void findBlocks(const DistanceField& field, const Grid& grid, const Cell& first, int cells,
                std::vector<Cell>& found) {
    const float half = 0.5f * float(cells) * grid.cell;
    const Eigen::Vector3f middle = grid.corner(first) + Eigen::Vector3f::Constant(half);
    if (std::abs(field(middle)) > kSlope * half * std::sqrt(3.0f)) return;
    if (cells == kBlock) {
        found.push_back(first);
        return;
    }
    forEachIn(2, [&](const Cell& octant) {
        findBlocks(field, grid, first + octant * (cells / 2), cells / 2, found);
    });
}

Block meshBlock(const DistanceField& field, const Grid& grid, const Cell& first) {
    Block block{.first = first, .inside = {}, .cells = {}, .positions = {}};
    std::vector<float> values(kCorners * kCorners * kCorners);
    forEachIn(kCorners, [&](const Cell& c) {
        const float value = field(grid.corner(first + c));
        values[Block::index(c)] = value;
        block.inside[Block::index(c)] = value < 0;
    });
    if (block.inside.none() || block.inside.all()) return block;
    forEachIn(kBlock, [&](const Cell& c) {
        Eigen::Vector3f mean;
        if (!crossing(values, c, mean)) return;
        const Eigen::Vector3f p = grid.corner(first) + grid.cell * mean;
        block.cells.push_back(first + c);
        block.positions.push_back(ontoSurface(field, p, gradient(values, c, grid.cell), grid.cell));
    });
    return block;
}

/// Joins the vertices of the four cells around each grid edge that the surface crosses.
void joinQuads(const Block& block,
               const std::unordered_map<std::uint64_t, std::uint32_t>& vertex_of,
               IsoSurface& surface) {
    forEachIn(kBlock, [&](const Cell& c) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool from = block.inside[Block::index(c)];
            if (from == block.inside[Block::index(c + unit(axis))]) continue;
            const Cell u = unit((axis + 1) % 3), v = unit((axis + 2) % 3), cell = block.first + c;
            std::array<std::uint32_t, 4> quad{};
            const std::array<Cell, 4> around = {cell - u - v, cell - v, cell, cell - u};
            bool complete = true;
            for (int i = 0; i < 4; ++i) {
                const auto found = vertex_of.find(key(around[i]));
                complete = complete && found != vertex_of.end();
                if (complete) quad[i] = found->second;
            }
            if (!complete) continue;  // at the border of the box
            if (!from) std::swap(quad[1], quad[3]);
            const auto& p = surface.positions;
            const bool first_diagonal =
                (p[quad[0]] - p[quad[2]]).squaredNorm() <= (p[quad[1]] - p[quad[3]]).squaredNorm();
            const int s = first_diagonal ? 0 : 1;
            surface.triangles.push_back({quad[s], quad[s + 1], quad[s + 2]});
            surface.triangles.push_back({quad[s], quad[s + 2], quad[(s + 3) % 4]});
        }
    });
}

}  // namespace

IsoSurface meshZeroSet(const DistanceField& field, const Eigen::AlignedBox3f& box, float cell_mm,
                       int threads) {
    // One cell of room below, so that the cells before the first are numbered from 0 too.
    const Grid grid{box.min() - Eigen::Vector3f::Constant(cell_mm), cell_mm};
    const Cell cubes = (box.sizes() / (cell_mm * kCube)).array().ceil().cast<int>();
    std::vector<Cell> found;
    for (int z = 0; z < cubes.z(); ++z) {
        for (int y = 0; y < cubes.y(); ++y) {
            for (int x = 0; x < cubes.x(); ++x) {
                findBlocks(field, grid, kCube * Cell(x, y, z) + Cell::Ones(), kCube, found);
            }
        }
    }
    std::vector<Block> blocks(found.size());
    forEach(int(found.size()), threads,
            [&](int i) { blocks[i] = meshBlock(field, grid, found[i]); });

    IsoSurface surface;
    std::unordered_map<std::uint64_t, std::uint32_t> vertex_of;
    for (const Block& block : blocks) {
        for (const Cell& cell : block.cells) {
            vertex_of.emplace(key(cell), std::uint32_t(vertex_of.size()));
        }
        surface.positions.insert(surface.positions.end(), block.positions.begin(),
                                 block.positions.end());
    }
    for (const Block& block : blocks) joinQuads(block, vertex_of, surface);
    return surface;
}

}  // namespace facescan::sim
