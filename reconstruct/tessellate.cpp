#include "reconstruct/tessellate.h"

#include <algorithm>
#include <array>
#include <bit>

#include "reconstruct/byte_group.h"
#include "reconstruct/kernels/form.h"

namespace facescan {
namespace {

/// Cuts every quad. @returns the mean of the triangles' longest edges, mm
float cutAll(const VertexGrid& grid, const PointPlanes& points, bool rising,
             TessellateScratch& scratch, Quads& quads) {
    const std::size_t size = grid.size() + VertexGrid::kBeyond;
    scratch.present.resize(size);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        scratch.present[i] = grid.cell[i] != Cell::empty;
    }
    scratch.first_longest.resize(size);
    scratch.second_longest.resize(size);
    scratch.lengths.resize(2 * std::size_t(grid.columns));
    for (auto* flags : {&quads.first, &quads.second, &quads.falling}) flags->assign(size, 0);

    std::int64_t length = 0;
    std::int64_t triangles = 0;
    for (int code = 1; code + 1 < grid.codes; ++code) {
        const Extent extent = quadExtent(grid, code);
        const int count = extent.end - extent.first;
        if (count <= 0) continue;
        const std::size_t north = grid.index(code, extent.first);
        const std::size_t south = north + grid.columns;
        std::int32_t* first_length = scratch.lengths.data();
        std::int32_t* second_length = first_length + grid.columns;
        kernels().cutQuads({rowFrom(points, north), rowFrom(points, south), &grid.y[north],
                            &grid.y[south], &scratch.present[north], &scratch.present[south]},
                           rising ? 1.0f : -1.0f, count,
                           {&quads.first[north], &quads.second[north], &quads.falling[north],
                            &scratch.first_longest[north], &scratch.second_longest[north],
                            first_length, second_length});
        std::int32_t row_length = 0;
        std::int32_t row_triangles = 0;
        for (int x = 0; x < count; ++x) {
            row_length += first_length[x] + second_length[x];
            row_triangles += quads.first[north + x] + quads.second[north + x];
        }
        length += row_length;
        triangles += row_triangles;
    }
    return triangles > 0 ? float(double(length) / double(triangles)) / kLengthUnits : 0.0f;
}

void dropLongTriangles(const VertexGrid& grid, float limit_mm, const TessellateScratch& scratch,
                       Quads& quads) {
    for (int code = 1; code + 1 < grid.codes; ++code) {
        const Extent extent = quadExtent(grid, code);
        const std::size_t i = grid.index(code, extent.first);
        const int count = extent.end - extent.first;
        const float limit = limit_mm * limit_mm;
        kernels().markShort(&scratch.first_longest[i], limit, count, &quads.first[i]);
        kernels().markShort(&scratch.second_longest[i], limit, count, &quads.second[i]);
    }
}

/// Marks the cells that are there and around which a triangle is missing.
FACESCAN_KERNEL void markSuspects(const QuadFlags& south, const QuadFlags& north,
                                  const std::uint8_t* __restrict present, int first, int end,
                                  std::uint8_t* __restrict suspect) {
    const std::uint8_t* __restrict a = south.first;
    const std::uint8_t* __restrict b = south.second;
    const std::uint8_t* __restrict c = north.first;
    const std::uint8_t* __restrict d = north.second;
#pragma GCC ivdep
    for (int x = first; x < end; ++x) {
        const std::uint8_t whole =
            a[x] & b[x] & c[x] & d[x] & a[x - 1] & b[x - 1] & c[x - 1] & d[x - 1];
        suspect[x] = present[x] & std::uint8_t(whole ^ 1);
    }
}

/// Leaves one fan of triangles around each vertex.
class FanFilter {
public:
    FanFilter(const VertexGrid& grid, Quads& quads) : grid_(grid), quads_(quads) {}

    /// What is dropped at one vertex can loosen the fans of its neighbours, which are then looked
    /// at again.
    void dropLooseFans(TessellateScratch& scratch) {
        scratch.again.clear();
        for (int code = 1; code < grid_.codes; ++code) {
            forEachSuspect(code, scratch, [&](int column) {
                if (dropAt(code, column)) addNeighbours(code, column, scratch.again);
            });
        }
        while (!scratch.again.empty()) {
            const std::size_t i = scratch.again.back();
            scratch.again.pop_back();
            const int code = int(i / grid_.columns);
            const int column = int(i % grid_.columns);
            if (dropAt(code, column)) addNeighbours(code, column, scratch.again);
        }
    }

private:
    /// Calls visit(column) for the cells of a row around which a triangle is missing.
    template <typename Visit>
    void forEachSuspect(int code, TessellateScratch& scratch, Visit visit) {
        const auto [first, end] = grid_.extent[code];
        if (first >= end) return;
        std::vector<std::uint8_t>& suspect = scratch.suspect;
        suspect.assign(std::size_t(grid_.columns) + VertexGrid::kBeyond, 0);
        const std::size_t row = grid_.index(code, 0);
        markSuspects(quads_.from(row), quads_.from(row - grid_.columns), &scratch.present[row],
                     std::max(first, 1), end, suspect.data());
        if (first == 0) suspect[0] = scratch.present[row];
        forEachMatch(suspect.data(), first, end, 1, visit);
    }

    static constexpr std::uint8_t kFirst = 1;
    static constexpr std::uint8_t kSecond = 2;

    /// A quad near a vertex; none where there is no such cell.
    struct Quad {
        std::uint8_t* first = nullptr;
        std::uint8_t* second = nullptr;
        bool falling = false;

        bool has(std::uint8_t which) const {
            return first && ((which & kFirst && *first) || (which & kSecond && *second));
        }
        void drop(std::uint8_t which) const {
            if (which & kFirst) *first = 0;
            if (which & kSecond) *second = 0;
        }
    };

    Quad quadAt(int code, int column) {
        if (code < 1 || column < 0 || column + 1 >= grid_.columns || code + 1 >= grid_.codes) {
            return {};
        }
        const std::size_t i = grid_.index(code, column);
        return {&quads_.first[i], &quads_.second[i], quads_.falling[i] != 0};
    }

    /// The triangles around a vertex as a ring of eight half corners, clockwise from north: two for
    /// each quad, the first half beside the edge that comes first. At the two corners on its cut, a
    /// quad's triangles hold half the corner each; at the other two, one triangle holds all of it.
    struct Ring {
        std::array<Quad, 4> quad;                         ///< north-east, south-east, …
        std::array<std::array<std::uint8_t, 2>, 4> half;  ///< the triangle that holds each

        std::uint8_t bits() const {
            unsigned bits = 0;
            for (int q = 0; q < 4; ++q) {
                for (int h = 0; h < 2; ++h)
                    bits |= unsigned(quad[q].has(half[q][h])) << (2 * q + h);
            }
            return std::uint8_t(bits);
        }
        void drop(std::uint8_t bits) const {
            for (int q = 0; q < 4; ++q) {
                for (int h = 0; h < 2; ++h) {
                    if (bits >> (2 * q + h) & 1) quad[q].drop(half[q][h]);
                }
            }
        }
    };

    Ring ringAt(int code, int column) {
        const Quad ne = quadAt(code - 1, column);      // the vertex is its south-west corner
        const Quad se = quadAt(code, column);          // … north-west
        const Quad sw = quadAt(code, column - 1);      // … north-east
        const Quad nw = quadAt(code - 1, column - 1);  // … south-east
        using Halves = std::array<std::uint8_t, 2>;
        return {{ne, se, sw, nw},
                {ne.falling ? Halves{kSecond, kSecond} : Halves{kFirst, kSecond},
                 se.falling ? Halves{kFirst, kSecond} : Halves{kFirst, kFirst},
                 sw.falling ? Halves{kFirst, kFirst} : Halves{kSecond, kFirst},
                 nw.falling ? Halves{kSecond, kFirst} : Halves{kSecond, kSecond}}};
    }

    bool dropAt(int code, int column) {
        const Ring ring = ringAt(code, column);
        const std::uint8_t bits = ring.bits();
        const unsigned starts = bits & ~std::rotl(bits, 1) & 0xFFu;
        if ((starts & (starts - 1)) == 0) return false;
        std::uint8_t largest = 0;
        for (unsigned rest = starts; rest != 0; rest &= rest - 1) {
            std::uint8_t fan = 0;
            for (std::uint8_t half = std::uint8_t(rest & (0u - rest)); bits & half & ~fan;
                 half = std::rotl(half, 1)) {
                fan |= half;
            }
            if (std::popcount(fan) > std::popcount(largest)) largest = fan;
        }
        ring.drop(std::uint8_t(bits & ~largest));
        return true;
    }

    void addNeighbours(int code, int column, std::vector<std::uint32_t>& cells) const {
        for (int c = std::max(code - 1, 1); c <= std::min(code + 1, grid_.codes - 1); ++c) {
            const int last = std::min(column + 1, grid_.columns - 1);
            for (int x = std::max(column - 1, 0); x <= last; ++x) {
                cells.push_back(std::uint32_t(grid_.index(c, x)));
            }
        }
    }

    const VertexGrid& grid_;
    Quads& quads_;
};

}  // namespace

void tessellate(const Options& options, const VertexGrid& grid, const PointPlanes& points,
                bool rising, TessellateScratch& scratch, Quads& quads) {
    const float mean_longest = cutAll(grid, points, rising, scratch, quads);
    dropLongTriangles(grid, float(options.max_edge_ratio) * mean_longest, scratch, quads);
    for (const std::uint32_t i : grid.gaps) quads.first[i] = quads.second[i] = 0;
    FanFilter(grid, quads).dropLooseFans(scratch);
}

}  // namespace facescan
