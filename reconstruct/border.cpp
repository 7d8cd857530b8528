#include "reconstruct/border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "reconstruct/byte_group.h"
#include "reconstruct/kernels/form.h"

namespace facescan {
namespace {

constexpr float kHalfPixel = 0.5f;
constexpr int kWellLit = 3;      // times the least modulation: no edge confirms these pixels
constexpr float kWidest = 1.5f;  // stripes widen or narrow by less from one to the next

/// Flags the cells that are the last of a column's run of measured cells, and not its first.
FACESCAN_KERNEL void markLast(const Cell* __restrict before, const Cell* __restrict here,
                              const Cell* __restrict next, int count,
                              std::uint8_t* __restrict last) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        last[x] =
            (here[x] == Cell::measured) & (before[x] == Cell::measured) & (next[x] == Cell::empty);
    }
}

Point between(const Point& a, const Point& b, float share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

/// Carries columns on from their last edges, in one direction.
class SurfaceCarrier {
public:
    /// @param step  of the code, −1 or 1
    SurfaceCarrier(const Options& options, const SeenStripes& seen, int step)
        : seen_(seen),
          least_modulation_(kWellLit * options.min_modulation),
          max_step_(float(options.max_step_px)),
          step_(step),
          outward_(seen.rising ? step : -step) {
        constexpr float kStill = 0.3f;  // px
        for (int pair = 0; pair < seen.bits; ++pair) {
            const ImageMotion& motion = seen.motions[pair];
            still_[pair] = motion.column * motion.column + motion.y * motion.y < kStill * kStill;
        }
    }

    int carry(BorderScratch& scratch, VertexGrid& grid, PointPlanes& points) const {
        scratch.last.assign(grid.columns + ByteGroup::kSize, 0);
        scratch.width.resize(grid.columns);
        scratch.shown.resize(grid.columns);
        int filled = 0;
        for (int code = 2; code + 1 < grid.codes; ++code) {
            const int first = grid.extent[code].first;
            const int end = grid.extent[code].end;
            if (first >= end) continue;
            const Cell* here = grid.cell.data() + grid.index(code, first);
            const std::ptrdiff_t row = std::ptrdiff_t(step_) * grid.columns;
            markLast(here - row, here, here + row, end - first, scratch.last.data() + first);
            bool any = false;
            forEachMatch(scratch.last.data(), first, end, 1, [&](int column) {
                any = true;
                lookAhead(code, column, grid, scratch);
            });
            if (!any) continue;
            forEachMatch(scratch.last.data(), first, end, 1, [&](int column) {
                if (!(scratch.shown[column] > kLeast)) return;
                const float width = smoothedWidth(code, column, first, end, grid, scratch);
                const float shown = std::fmin(scratch.shown[column], width);
                filled += carryOn(code, column, width, shown, grid, points);
            });
        }
        return filled;
    }

private:
    static constexpr float kFar = 1e9f;
    static constexpr float kLeast = 1;  // px: triangles lower than this would point anywhere

    /// Notes how far the next edge lies from the last of a column, and how far it is seen, px.
    void lookAhead(int code, int column, const VertexGrid& grid, BorderScratch& scratch) const {
        const float expected = float(outward_) * nextWidth(grid, code, column);
        const StripeEnd end = findStripeEnd(grid, code, column, kWidest * expected);
        // The rows leave the edge the gap between two pixels' middles.
        const float least = end.width - kHalfPixel;
        const float most = end.width + kHalfPixel;
        scratch.width[column] =
            end.at_edge ? std::fmin(std::fmax(expected, least), most) : expected;
        scratch.shown[column] = end.at_edge ? kFar : end.width;
    }

    /// The mean over the columns around: a pixel's row is a coarse place, and one column noisy.
    float smoothedWidth(int code, int column, int first, int end, const VertexGrid& grid,
                        const BorderScratch& scratch) const {
        constexpr int kReach = 4;
        const float own = scratch.width[column];
        float sum = 0;
        int count = 0;
        for (int x = std::max(column - kReach, first); x <= std::min(column + kReach, end - 1);
             ++x) {
            float width = scratch.width[x];
            if (!scratch.last[x]) {
                const std::size_t here = grid.index(code, x);
                const std::size_t next = grid.index(code + step_, x);
                if (grid.cell[here] != Cell::measured || grid.cell[next] != Cell::measured) {
                    continue;
                }
                width = float(outward_) * (grid.y[next] - grid.y[here]);
            }
            if (std::fabs(width - own) > max_step_) continue;
            sum += width;
            ++count;
        }
        return count > 0 ? sum / float(count) : own;
    }

    /// Where the pixels beyond an edge stop to show its stripe.
    struct StripeEnd {
        float width;   ///< from the edge, px
        bool at_edge;  ///< the next stripe follows: the same surface goes on
    };

    /// Fills the cell after a column's last edge.
    bool carryOn(int code, int column, float width, float shown, VertexGrid& grid,
                 PointPlanes& points) const {
        if (!(shown > kLeast)) return false;
        const std::size_t last = grid.index(code, column);
        const std::size_t next = grid.index(code + step_, column);
        const float place = grid.y[last] + float(outward_) * shown;
        if (!runsOn(grid, code + step_, column, place)) return false;
        const Point edge =
            seen_.calibration.at(code + step_, column, grid.y[last] + float(outward_) * width);
        points.set(next, between(points[last], edge, shown / width));
        grid.y[next] = place;
        grid.contrast[next] = 0;
        grid.cell[next] = Cell::filled;
        Extent& extent = grid.extent[code + step_];
        extent.first = std::min(extent.first, column);
        extent.end = std::max(extent.end, column + 1);
        cutOff(code + step_, column, width, grid);
        return true;
    }

    /// How far the next edge lies from the last of a column, px: the stripes go on widening, at
    /// half the rate at which they did, since two differences of places carry more noise than one.
    float nextWidth(const VertexGrid& grid, int code, int column) const {
        const float* y = grid.y.data();
        const std::size_t before = grid.index(code - step_, column);
        const float width = y[grid.index(code, column)] - y[before];
        const int third = code - 2 * step_;
        if (third < 1 || third >= grid.codes) return width;
        const std::size_t i = grid.index(third, column);
        if (grid.cell[i] != Cell::measured) return width;
        const float next = width + 0.5f * (width - (y[before] - y[i]));
        const float ratio = next / width;
        return ratio > 1 / kWidest && ratio < kWidest ? next : width;
    }

    /// Looks from an edge outward, no farther than `width`.
    StripeEnd findStripeEnd(const VertexGrid& grid, int code, int column, float width) const {
        const float y = grid.y[grid.index(code, column)];
        const int own = step_ > 0 ? code : code - 1;
        int row = outward_ > 0 ? int(std::floor(y)) + 1 : int(std::ceil(y)) - 1;
        const bool still = still_[pairOfEdge(code + step_, seen_.bits)];
        const auto beyond = [&](float r) { return float(outward_) * (r - y); };
        for (; beyond(float(row)) - kHalfPixel < width; row += outward_) {
            if (row < 0 || row >= seen_.planes.height)
                return {beyond(float(row)) - kHalfPixel, false};
            const std::size_t i = seen_.planes.index(column, row);
            if (seen_.planes.modulation[i] < least_modulation_) break;
            const int stripe = seen_.planes.stripe[i];
            if (stripe == own + step_ && still) return {beyond(float(row)) - kHalfPixel, true};
            // Where the face moved, the pixels show the stripes as they lay at other moments.
            if (std::abs(stripe - own) > 1) break;
        }
        // Half of the last pixel may show what lies behind.
        return {beyond(float(row)) - 2 * kHalfPixel, false};
    }

    /// Whether a row runs on through a cell at this place.
    bool runsOn(const VertexGrid& grid, int code, int column, float place) const {
        for (const int x : {std::max(column - 1, 0), std::min(column + 1, grid.columns - 1)}) {
            const std::size_t beside = grid.index(code, x);
            if (grid.cell[beside] == Cell::measured &&
                std::fabs(grid.y[beside] - place) > max_step_) {
                return false;
            }
        }
        return true;
    }

    /// Cuts what is carried on from what lies beyond, unless that is as near as the next stripe.
    void cutOff(int code, int column, float width, VertexGrid& grid) const {
        constexpr float kLeastWidth = 1;  // px
        constexpr float kMostWidths = 1.5f;
        const int beyond = code + step_;
        if (beyond < 1 || beyond >= grid.codes) return;
        const float place = grid.y[grid.index(code, column)];
        const auto isApart = [&](int x) {
            const std::size_t i = grid.index(beyond, x);
            const float distance = float(outward_) * (grid.y[i] - place);
            const bool near = distance >= kLeastWidth && distance <= kMostWidths * width;
            return grid.cell[i] != Cell::empty && !near;
        };
        const bool here = isApart(column);
        const auto quad = std::uint32_t(grid.index(std::min(code, beyond), column));
        if (column > 0 && (here || isApart(column - 1))) grid.gaps.push_back(quad - 1);
        if (column + 1 < grid.columns && (here || isApart(column + 1))) grid.gaps.push_back(quad);
    }

    const SeenStripes& seen_;
    std::array<bool, kMaxBits> still_{};  ///< whether the pair's edges are where they were seen
    int least_modulation_;
    float max_step_;
    int step_;
    int outward_;  ///< the direction of y
};

}  // namespace

int carryToBorder(const Options& options, const SeenStripes& seen, BorderScratch& scratch,
                  VertexGrid& grid, PointPlanes& points) {
    int filled = 0;
    for (const int step : {-1, 1}) {
        filled += SurfaceCarrier(options, seen, step).carry(scratch, grid, points);
    }
    return filled;
}

}  // namespace facescan
