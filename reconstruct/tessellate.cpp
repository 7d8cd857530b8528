#include "reconstruct/tessellate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace facescan {
namespace {

// A quad of cells, north at the lower code and west at the lower column:
//
//     nw --- ne
//      |     |
//     sw --- se
//
// It is cut along nw–se (falling) or ne–sw. Of its two triangles, "first" is the one with the
// north edge. A quad of three cells is cut so that they form one of the two.
constexpr std::uint8_t kFirst = 1;
constexpr std::uint8_t kSecond = 2;
constexpr std::uint8_t kFalling = 4;

constexpr std::uint32_t kNone = ~std::uint32_t(0);

float squaredDistance(const Point& a, const Point& b) {
    const float x = a.x - b.x;
    const float y = a.y - b.y;
    const float z = a.z - b.z;
    return x * x + y * y + z * z;
}

/// The cells of a quad's triangles, north-west cell `nw`, in the order in which they turn from the
/// lower column to the higher code.
struct QuadCells {
    std::size_t nw, ne, sw, se;

    QuadCells(std::size_t north_west, int columns)
        : nw(north_west), ne(nw + 1), sw(nw + columns), se(sw + 1) {}

    std::array<std::size_t, 3> first(bool falling) const {
        return falling ? std::array{nw, ne, se} : std::array{nw, ne, sw};
    }
    std::array<std::size_t, 3> second(bool falling) const {
        return falling ? std::array{nw, se, sw} : std::array{ne, se, sw};
    }
};

class Tessellator {
public:
    Tessellator(const VertexGrid& grid, const std::vector<Point>& points, bool rising,
                std::vector<std::uint8_t>& quads)
        : grid_(grid), points_(points), sign_(rising ? 1.0f : -1.0f), quads_(quads) {
        quads_.assign(grid.size(), 0);
    }

    /// Cuts every quad, and returns the mean of the triangles' longest edges, mm.
    float cutQuads() {
        double sum = 0;
        int count = 0;
        forEachQuad([&](std::size_t i) {
            quads_[i] = cut(i);
            forEachTriangle(i, [&](std::uint8_t, const auto& cells) {
                sum += std::sqrt(longestSquared(cells));
                ++count;
            });
        });
        return count > 0 ? float(sum / count) : 0.0f;
    }

    void dropTrianglesLongerThan(float limit) {
        forEachQuad([&](std::size_t i) {
            forEachTriangle(i, [&](std::uint8_t which, const auto& cells) {
                if (longestSquared(cells) >= limit * limit) quads_[i] &= std::uint8_t(~which);
            });
        });
    }

    /// Leaves one fan of triangles around each vertex. What is dropped at one vertex can loosen the
    /// fans of its neighbours, which are then looked at again.
    void dropLooseFans(std::vector<std::uint32_t>& again) {
        again.clear();
        for (int code = 1; code < grid_.codes; ++code) {
            for (int column = 0; column < grid_.columns; ++column) {
                if (!present(grid_.index(code, column))) continue;
                if (dropLooseFansAt(code, column)) addNeighbours(code, column, again);
            }
        }
        while (!again.empty()) {
            const std::size_t i = again.back();
            again.pop_back();
            const int code = int(i / grid_.columns);
            const int column = int(i % grid_.columns);
            if (dropLooseFansAt(code, column)) addNeighbours(code, column, again);
        }
    }

    template <typename Visit>
    void forEachQuad(Visit visit) const {
        for (int code = 1; code + 1 < grid_.codes; ++code) {
            for (int column = 0; column + 1 < grid_.columns; ++column) {
                visit(grid_.index(code, column));
            }
        }
    }

    /// Calls visit(kFirst or kSecond, cells) for the triangles that a quad carries.
    template <typename Visit>
    void forEachTriangle(std::size_t i, Visit visit) const {
        const std::uint8_t quad = quads_[i];
        const QuadCells cells(i, grid_.columns);
        const bool falling = quad & kFalling;
        if (quad & kFirst) visit(kFirst, cells.first(falling));
        if (quad & kSecond) visit(kSecond, cells.second(falling));
    }

private:
    bool present(std::size_t i) const { return grid_.cell[i] != Cell::empty; }

    std::uint8_t cut(std::size_t i) const {
        const QuadCells q(i, grid_.columns);
        const int corners = present(q.nw) + present(q.ne) + present(q.sw) + present(q.se);
        if (corners < 3) return 0;
        bool falling;
        std::uint8_t quad;
        if (corners == 4) {
            falling = squaredDistance(points_[q.nw], points_[q.se]) <=
                      squaredDistance(points_[q.ne], points_[q.sw]);
            quad = kFirst | kSecond;
        } else {
            falling = present(q.nw) && present(q.se);
            const bool north = present(q.nw) && present(q.ne);
            quad = north ? kFirst : kSecond;
        }
        if (falling) quad |= kFalling;
        if ((quad & kFirst) && !faces(q.first(falling))) quad &= std::uint8_t(~kFirst);
        if ((quad & kSecond) && !faces(q.second(falling))) quad &= std::uint8_t(~kSecond);
        return quad;
    }

    /// Whether a triangle turns in the image as it does on the grid: the camera sees its front.
    bool faces(const std::array<std::size_t, 3>& cells) const {
        constexpr float kSmallest = 1e-3f;  // twice the area, px²
        const auto x = [&](int k) { return float(int(cells[k] % grid_.columns)); };
        const auto y = [&](int k) { return sign_ * grid_.y[cells[k]]; };
        const float area = (x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0));
        return area > kSmallest;
    }

    float longestSquared(const std::array<std::size_t, 3>& cells) const {
        const Point& a = points_[cells[0]];
        const Point& b = points_[cells[1]];
        const Point& c = points_[cells[2]];
        return std::max({squaredDistance(a, b), squaredDistance(b, c), squaredDistance(c, a)});
    }

    /// The triangles around a vertex as a ring of eight half corners, clockwise from north: two for
    /// each quad, the first half beside the edge that comes first. A triangle that holds the whole
    /// corner sets both.
    std::uint8_t ringAt(int code, int column) const {
        const auto quad = [&](int c, int x) -> std::uint8_t {
            if (c < 1 || x < 0 || x + 1 >= grid_.columns || c + 1 >= grid_.codes) return 0;
            return quads_[grid_.index(c, x)];
        };
        const auto halves = [](bool a, bool b) { return unsigned(a) | unsigned(b) << 1; };
        // At the two corners on its cut, a quad's triangles hold half the corner each; at the other
        // two, one triangle holds all of it.
        const std::uint8_t ne = quad(code - 1, column);      // the vertex is its south-west corner
        const std::uint8_t se = quad(code, column);          // … north-west
        const std::uint8_t sw = quad(code, column - 1);      // … north-east
        const std::uint8_t nw = quad(code - 1, column - 1);  // … south-east
        const unsigned ring_ne =
            ne & kFalling ? halves(ne & kSecond, ne & kSecond) : halves(ne & kFirst, ne & kSecond);
        const unsigned ring_se =
            se & kFalling ? halves(se & kFirst, se & kSecond) : halves(se & kFirst, se & kFirst);
        const unsigned ring_sw =
            sw & kFalling ? halves(sw & kFirst, sw & kFirst) : halves(sw & kSecond, sw & kFirst);
        const unsigned ring_nw =
            nw & kFalling ? halves(nw & kSecond, nw & kFirst) : halves(nw & kSecond, nw & kSecond);
        return std::uint8_t(ring_ne | ring_se << 2 | ring_sw << 4 | ring_nw << 6);
    }

    /// Removes the triangles that set any of `halves` of the ring around a vertex.
    void dropHalves(int code, int column, std::uint8_t halves) {
        const auto drop = [&](int c, int x, unsigned pair_of_halves, std::uint8_t falling_a,
                              std::uint8_t falling_b, std::uint8_t rising_a,
                              std::uint8_t rising_b) {
            if (pair_of_halves == 0) return;
            std::uint8_t& quad = quads_[grid_.index(c, x)];
            const bool falling = quad & kFalling;
            if (pair_of_halves & 1) quad &= std::uint8_t(~(falling ? falling_a : rising_a));
            if (pair_of_halves & 2) quad &= std::uint8_t(~(falling ? falling_b : rising_b));
        };
        drop(code - 1, column, halves & 3u, kSecond, kSecond, kFirst, kSecond);
        drop(code, column, halves >> 2 & 3u, kFirst, kSecond, kFirst, kFirst);
        drop(code, column - 1, halves >> 4 & 3u, kFirst, kFirst, kSecond, kFirst);
        drop(code - 1, column - 1, halves >> 6 & 3u, kSecond, kFirst, kSecond, kSecond);
    }

    void addNeighbours(int code, int column, std::vector<std::uint32_t>& cells) const {
        for (int c = std::max(code - 1, 1); c <= std::min(code + 1, grid_.codes - 1); ++c) {
            const int last = std::min(column + 1, grid_.columns - 1);
            for (int x = std::max(column - 1, 0); x <= last; ++x) {
                cells.push_back(std::uint32_t(grid_.index(c, x)));
            }
        }
    }

    bool dropLooseFansAt(int code, int column) {
        const std::uint8_t ring = ringAt(code, column);
        const unsigned starts = ring & ~std::rotl(ring, 1) & 0xFFu;
        if ((starts & (starts - 1)) == 0) return false;
        std::uint8_t largest = 0;
        for (unsigned rest = starts; rest != 0; rest &= rest - 1) {
            std::uint8_t fan = 0;
            for (std::uint8_t half = std::uint8_t(rest & (0u - rest)); ring & half & ~fan;
                 half = std::rotl(half, 1)) {
                fan |= half;
            }
            if (std::popcount(fan) > std::popcount(largest)) largest = fan;
        }
        dropHalves(code, column, std::uint8_t(ring & ~largest));
        return true;
    }

    const VertexGrid& grid_;
    const std::vector<Point>& points_;
    float sign_;
    std::vector<std::uint8_t>& quads_;
};

/// Lays down the vertices of the cells, and says where the camera sees them in the texture.
class VertexWriter {
public:
    VertexWriter(const ScanDescription& scan, const VertexGrid& grid,
                 const std::vector<Point>& points, const EdgeNoise& noise)
        : image_(scan.image),
          turned_(scan.pattern.axis == CodeAxis::x),
          grid_(grid),
          points_(points),
          noise_(noise) {}

    Vertex at(std::size_t i) const {
        const float across = float(int(i % grid_.columns));
        const float along = grid_.y[i];
        const float image_x = turned_ ? along : across;
        const float image_y = turned_ ? across : along;
        const Point& p = points_[i];
        return {.x = p.x,
                .y = p.y,
                .z = p.z,
                .nx = 0,
                .ny = 0,
                .nz = 0,
                .s = (image_x + 0.5f) / float(image_.width),
                .t = 1.0f - (image_y + 0.5f) / float(image_.height),
                .quality = quality(i)};
    }

private:
    /// 1 for an edge without noise, ½ where its noise is a fifth of a pixel.
    float quality(std::size_t i) const {
        constexpr float kHalf = 0.2f;
        constexpr float kSmallest = 1e-3f;
        if (grid_.cell[i] == Cell::filled) return 0;
        const float noise_px =
            grid_.light[i].contrast > 0 ? noise_.pixels(grid_.light[i].contrast) : 1e3f;
        const float u = noise_px / kHalf;
        return std::max(kSmallest, 1.0f / (1.0f + u * u));
    }

    Rect image_;
    bool turned_;
    const VertexGrid& grid_;
    const std::vector<Point>& points_;
    EdgeNoise noise_;
};

}  // namespace

void tessellate(const ScanDescription& scan, const Options& options, const VertexGrid& grid,
                const std::vector<Point>& points, bool rising, const EdgeNoise& noise,
                TessellateScratch& scratch, Mesh& mesh) {
    Tessellator tessellator(grid, points, rising, scratch.quads);
    const float mean_longest = tessellator.cutQuads();
    tessellator.dropTrianglesLongerThan(float(options.max_edge_ratio) * mean_longest);
    tessellator.dropLooseFans(scratch.vertex);

    mesh.vertices.clear();
    mesh.triangles.clear();
    scratch.vertex.assign(grid.size(), kNone);
    const VertexWriter writer(scan, grid, points, noise);
    // On the grid the triangles turn from the column's direction to the code's. Seen in the image
    // that is clockwise; a falling code turns it round, and so does a turned image.
    const bool swap = rising != (scan.pattern.axis == CodeAxis::x);
    tessellator.forEachQuad([&](std::size_t i) {
        tessellator.forEachTriangle(i, [&](std::uint8_t, const auto& cells) {
            Triangle triangle;
            for (int k = 0; k < 3; ++k) {
                std::uint32_t& vertex = scratch.vertex[cells[k]];
                if (vertex == kNone) {
                    vertex = std::uint32_t(mesh.vertices.size());
                    mesh.vertices.push_back(writer.at(cells[k]));
                }
                triangle[k] = vertex;
            }
            if (swap) std::swap(triangle[1], triangle[2]);
            mesh.triangles.push_back(triangle);
        });
    });
}

}  // namespace facescan
