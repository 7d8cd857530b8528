#include "reconstruct/border.h"

#include <algorithm>
#include <cmath>

namespace facescan {
namespace {

constexpr float kHalfPixel = 0.5f;

/// The image's first or last row.
struct Border {
    int row;
    float outward;    ///< −1 or 1: the direction of y
    int code_toward;  ///< the code's step towards it

    /// How far beyond the middle of the row's pixels, px.
    float beyond(float y) const { return outward * (y - float(row)); }
    /// Where the row's pixels end, px.
    float end() const { return float(row) + outward * kHalfPixel; }
};

Point between(const Point& a, const Point& b, float share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

/// The code of the edge before the stripe that the pixel at the border shows.
int lastCode(const PixelPlanes& planes, const Border& border, int column) {
    const int stripe = planes.stripe[planes.index(column, border.row)];
    return border.code_toward > 0 ? stripe : stripe + 1;
}

/// How far the next edge lies from the last of a column, px: the stripes go on widening, at half
/// the rate at which they did, since two differences of places carry more noise than one.
float nextWidth(const VertexGrid& grid, int code, int column, int step) {
    constexpr float kWidest = 1.5f;
    const float* y = grid.y.data();
    const std::size_t before = grid.index(code - step, column);
    const float width = y[grid.index(code, column)] - y[before];
    const int third = code - 2 * step;
    if (third < 1 || third >= grid.codes) return width;
    const std::size_t i = grid.index(third, column);
    if (grid.cell[i] != Cell::measured) return width;
    const float next = width + 0.5f * (width - (y[before] - y[i]));
    const float ratio = next / width;
    return ratio > 1 / kWidest && ratio < kWidest ? next : width;
}

/// Fills the cell after a column's last edge, where that edge is the column's last.
bool carryOn(const GridCalibration& calibration, const Border& border, int code, int column,
             VertexGrid& grid, PointPlanes& points) {
    constexpr float kLeast = 1;  // px: triangles lower than this would point anywhere
    const int step = border.code_toward;
    if (code < 2 || code + 1 >= grid.codes) return false;
    const std::size_t last = grid.index(code, column);
    const std::size_t before = grid.index(code - step, column);
    const std::size_t next = grid.index(code + step, column);
    if (grid.cell[last] != Cell::measured || grid.cell[before] != Cell::measured ||
        grid.cell[next] != Cell::empty) {
        return false;
    }
    const float width = nextWidth(grid, code, column, step);
    const float place = grid.y[last] + width;
    const float to_border = kHalfPixel - border.beyond(grid.y[last]);
    if (border.outward * width <= 0 || to_border <= kLeast || border.beyond(place) <= 0) {
        return false;
    }
    const Point edge = calibration.at(code + step, column, place);
    const float share = std::fmin(to_border / std::fabs(width), 1.0f);
    points.set(next, between(points[last], edge, share));
    grid.y[next] = share < 1 ? border.end() : place;
    grid.contrast[next] = 0;
    grid.cell[next] = Cell::filled;
    Extent& extent = grid.extent[code + step];
    extent.first = std::min(extent.first, column);
    extent.end = std::max(extent.end, column + 1);
    return true;
}

}  // namespace

int carryToBorder(const GridCalibration& calibration, const PixelPlanes& planes, bool rising,
                  VertexGrid& grid, PointPlanes& points) {
    const int sign = rising ? 1 : -1;
    int filled = 0;
    for (const Border& border : {Border{0, -1, -sign}, Border{planes.height - 1, 1, sign}}) {
        for (int column = 0; column < grid.columns; ++column) {
            // A moving face shows the stripe in frames of other moments, a stripe off.
            const int code = lastCode(planes, border, column);
            for (const int candidate : {code - 1, code, code + 1}) {
                filled += carryOn(calibration, border, candidate, column, grid, points);
            }
        }
    }
    return filled;
}

}  // namespace facescan
