#include "reconstruct/surface_motion.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/grid_sample.h"
#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

using Vector = std::array<float, 3>;

Vector operator-(const Point& a, const Point& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector toVector(const Point& p) {
    return {p.x, p.y, p.z};
}
float dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The finest pair's surface beside an edge: its columns lie far enough apart to average the noise,
// near enough to follow a face.
constexpr int kReach = 4;
constexpr float kEdgeOn = 0.15f;  // mm per px: seen more edge on, the surface tells nothing
constexpr float kJump = 1.5f;     // two rows farther apart than the next are two surfaces …
constexpr float kBend = 1;        // … and so is a row that bends more than this, px

bool isMeasured(const VertexGrid& grid, std::size_t i) {
    return grid.cell[i] == Cell::measured;
}

/// Where the finest pair's surface crosses the line of an edge of an even code: a cubic through the
/// rows around.
float placeOnReference(const VertexGrid& grid, int code, std::size_t i) {
    const std::size_t row = grid.columns;
    const float near = grid.y[i - row] + grid.y[i + row];
    const bool wide = code >= 4 && code + 3 < grid.codes && isMeasured(grid, i - 3 * row) &&
                      isMeasured(grid, i + 3 * row);
    if (!wide) return 0.5f * near;
    const float far = grid.y[i - 3 * row] + grid.y[i + 3 * row];
    return (9 * near - far) * (1.0f / 16.0f);
}

/// What holds beside a jump of the surface, where the finest pair's rows above and below an edge
/// are not one surface. Of the grid it reads the edge itself and rows of odd codes, which do not
/// move.
class BesideJump {
public:
    explicit BesideJump(const MeasuredSurface& surface)
        : calibration_(surface.calibration), grid_(surface.grid), points_(surface.points) {}

    /// How far a motion moves an edge, by the plane through two rows of the side where its own
    /// surface is. Leaves `shift` as it is where there is none.
    void shiftAt(int code, int column, const Point& centre, const RigidMotion& motion,
                 float& shift) const {
        Vector normal;
        float mm_per_px;
        if (!planeAt(code, column, normal, mm_per_px)) return;
        const Vector lever = points_[grid_.index(code, column)] - centre;
        const Vector turned = cross(motion.rotation, lever);
        Vector moved;
        for (int k = 0; k < 3; ++k) moved[k] = motion.translation[k] + turned[k];
        shift = dot(normal, moved) / mm_per_px;
    }

    /// Whether an edge that lies at `y` by now runs along the outline of a surface: on one side the
    /// finest pair's surface ends, and on the other it is nearer than it should be.
    bool isOutline(int code, int column, float y) const {
        return endsAt(code, -1, column, y) || endsAt(code, 1, column, y);
    }

private:
    static constexpr float kFar = 1e9f;

    bool planeAt(int code, int column, Vector& normal, float& mm_per_px) const {
        const float above = distance(code, code - 1, column);
        const float below = distance(code, code + 1, column);
        const bool either = passes(code, column);
        if ((either || below < above) && code + 3 < grid_.codes &&
            planeBetween(code + 1, code + 3, code, column, normal, mm_per_px)) {
            return true;
        }
        return (either || above < below) && code > 3 &&
               planeBetween(code - 3, code - 1, code, column, normal, mm_per_px);
    }

    /// Between the edges of two codes in a column, px; far where there is none.
    float distance(int code, int other, int column) const {
        if (other < 1 || other >= grid_.codes) return kFar;
        const std::size_t a = grid_.index(code, column);
        const std::size_t b = grid_.index(other, column);
        const bool both = isMeasured(grid_, a) && isMeasured(grid_, b);
        return both ? std::fabs(grid_.y[a] - grid_.y[b]) : kFar;
    }

    /// Whether the finest pair's surface passes a cell without a jump.
    bool passes(int code, int column) const {
        const float next =
            std::fmax(distance(code - 1, code - 3, column), distance(code + 1, code + 3, column));
        return distance(code - 1, code + 1, column) <= kJump * next;
    }

    /// Whether the surface on the side of `inward` ends at an edge, and comes too near to it.
    bool endsAt(int code, int inward, int column, float y) const {
        constexpr float kGap = 2;
        constexpr float kSqueezed = 0.8f;
        const float next = distance(code + inward, code + 3 * inward, column);
        if (next >= kFar) return false;
        const float width = std::fabs(grid_.y[grid_.index(code + inward, column)] - y);
        if (width >= kSqueezed * 0.5f * next) return false;
        const std::size_t outer = grid_.index(code - inward, column);
        return !isMeasured(grid_, outer) || std::fabs(grid_.y[outer] - y) > kGap * width;
    }

    /// Whether a row runs on around a cell without a jump or a crease.
    bool runsOn(std::size_t i) const {
        return isMeasured(grid_, i) && isMeasured(grid_, i - kReach) &&
               isMeasured(grid_, i + kReach) &&
               std::fabs(2 * grid_.y[i] - grid_.y[i - kReach] - grid_.y[i + kReach]) < kBend;
    }

    /// The plane through two rows of the finest pair, for the edge of another.
    bool planeBetween(int upper, int lower, int code, int column, Vector& normal,
                      float& mm_per_px) const {
        if (column < kReach || column + kReach >= grid_.columns) return false;
        const std::size_t above = grid_.index(upper, column);
        const std::size_t below = grid_.index(lower, column);
        if (!runsOn(above) || !runsOn(below)) return false;
        const Vector left = points_[below - kReach] - points_[above - kReach];
        const Vector middle = points_[below] - points_[above];
        const Vector right = points_[below + kReach] - points_[above + kReach];
        const Vector along_above = points_[above + kReach] - points_[above - kReach];
        const Vector along_below = points_[below + kReach] - points_[below - kReach];
        Vector along;
        Vector across;
        for (int k = 0; k < 3; ++k) {
            along[k] = along_above[k] + along_below[k];
            across[k] = middle[k] + right[k] + left[k];
        }
        normal = cross(along, across);
        const float length = std::sqrt(dot(normal, normal));
        if (!(length > 0)) return false;
        for (float& n : normal) n /= length;
        const float y = grid_.y[grid_.index(code, column)];
        mm_per_px = dot(normal, toVector(calibration_.slopeAt(code, column, y)));
        return std::fabs(mm_per_px) > kEdgeOn;
    }

    const GridCalibration& calibration_;
    const VertexGrid& grid_;
    const PointPlanes& points_;
};

/// The motion of the face at its middle that the motion of its image shows.
class ImageToSpace {
public:
    ImageToSpace(const GridCalibration& calibration, const VertexGrid& grid,
                 const SurfaceMiddle& middle) {
        const float y = middle.place.y;
        centre_ = calibration.at(middle.code, middle.column, y);
        const Point next_y = calibration.at(middle.code, middle.column, y + 1);
        const int side = middle.column + 1 < grid.columns ? 1 : -1;
        const Point next_column = calibration.at(middle.code, middle.column + side, y);
        per_y_ = lateral(next_y, 1.0f);
        per_column_ = lateral(next_column, float(side));
    }

    const Point& centre() const { return centre_; }

    /// X and Y in mm, at constant depth, that undo the image's shift.
    std::array<float, 2> undoShift(const ImageMotion& m) const {
        return {-(m.column * per_column_[0] + m.y * per_y_[0]),
                -(m.column * per_column_[1] + m.y * per_y_[1])};
    }

    /// Depth in mm that undoes the image's scaling: what comes nearer grows.
    float undoScale(const ImageMotion& m) const { return m.scale * centre_.z; }

    /// The turn about the depth axis that undoes the image's.
    float undoTurn(const ImageMotion& m) const {
        const float handedness = per_column_[0] * per_y_[1] - per_column_[1] * per_y_[0];
        return handedness > 0 ? -m.turn : m.turn;
    }

private:
    std::array<float, 2> lateral(const Point& next, float sign) const {
        return {sign * centre_.z * (next.x / next.z - centre_.x / centre_.z),
                sign * centre_.z * (next.y / next.z - centre_.y / centre_.z)};
    }

    Point centre_;
    std::array<float, 2> per_column_{};
    std::array<float, 2> per_y_{};
};

/// How well the image tells the motion, as standard deviations.
constexpr float kImageShiftMm = 0.003f;
constexpr float kImageDepthMm = 0.05f;
constexpr float kImageTurnRad = 0.0002f;
/// How much a head turns against the scanner from one pair to the next.
constexpr float kTurnStepRad = 0.0007f;

/// Flags the cells with an edge around which the points of the rows above and below are measured.
FACESCAN_KERNEL void markBetween(const Cell* __restrict cell, const std::uint8_t* __restrict above,
                                 const std::uint8_t* __restrict below, int count,
                                 std::uint8_t* __restrict flags) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        const std::uint8_t there = cell[x] != Cell::empty ? 1 : 0;
        flags[x] = there & above[x] & above[x - kReach] & above[x + kReach] & below[x] &
                   below[x - kReach] & below[x + kReach];
    }
}

/// The equations of a pair's vertices.
void collectEquations(const MeasuredSurface& surface, const Point& centre, int pair, int bits,
                      AlignmentEquations& equations) {
    // Neighbouring columns say nearly the same, and some thousand vertices as much as all.
    constexpr int kLeastSpacing = 3;
    constexpr int kEnough = 4000;
    const VertexGrid& grid = surface.grid;
    const ReferencePlanes& planes = surface.planes;
    const int step = 1 << (bits - 1 - pair);
    const int cells = grid.codes / (2 * step) * grid.columns;
    const int spacing = std::max(kLeastSpacing, cells / kEnough);
    std::size_t count = 0;
    const auto makeRoom = [&](std::size_t size) {
        for (std::vector<float>& plane : equations.row) plane.resize(size);
        equations.distance.resize(size);
    };
    for (int code = step; code + 1 < grid.codes; code += 2 * step) {
        const auto [first, end] = grid.extent[code];
        if (first >= end) continue;
        makeRoom(count + std::size_t((end - first) / spacing + 1));
        for (int column = first + code / step % spacing; column < end; column += spacing) {
            const std::size_t i = grid.index(code, column);
            if (!planes.known[i] || grid.cell[i] != Cell::measured) continue;
            const Vector n = toVector(planes.normal[i]);
            const Vector lever = cross(surface.points[i] - centre, n);
            for (int k = 0; k < 3; ++k) {
                equations.row[k][count] = n[k];
                equations.row[3 + k][count] = lever[k];
            }
            equations.distance[count++] =
                (placeOnReference(grid, code, i) - grid.y[i]) * planes.mm_per_px[i];
        }
    }
    equations.count = int(count);
    const std::size_t padded = (count + kSumLanes - 1) / kSumLanes * kSumLanes;
    makeRoom(padded);
    for (std::vector<float>& plane : equations.row) {
        std::fill(plane.begin() + std::ptrdiff_t(count), plane.end(), 0.0f);
    }
    std::fill(equations.distance.begin() + std::ptrdiff_t(count), equations.distance.end(), 0.0f);
}

/// The weight of an equation whose value has this standard deviation.
float weightOf(float deviation) {
    return 1 / (deviation * deviation);
}

/// What moves in depth or turns also shifts in the image: where the image stands still, so does the
/// face, and the surface's noise is not to be taken for a motion.
float motionLooseness(const ImageMotion& image) {
    constexpr float kStill = 0.1f;
    const float shift_px = std::sqrt(image.column * image.column + image.y * image.y);
    return kStill + std::fmin(shift_px, 1.0f);
}

RigidMotion alignPair(const AlignmentEquations& vertices, const ImageToSpace& to_space,
                      const ImageMotion& image, const RigidMotion& next) {
    constexpr int kSteps = 4;
    constexpr float kSettledMm = 0.001f;
    constexpr float kSettledRad = 1e-5f;
    constexpr float kModelErrorMm = 0.05f;  // a vertex is not trusted beyond this
    constexpr float kIndependent = 1000;    // … nor are thousands of them more than this many
    constexpr float kCut = 3.5f;            // of the robust weights, mean absolute residuals
    using Equations = NormalEquations<float, 6>;

    const Point& centre = to_space.centre();
    const std::array<float, 2> lateral = to_space.undoShift(image);
    const float depth = to_space.undoScale(image);
    const float turn = to_space.undoTurn(image);
    Equations::Vector motion{lateral[0],       lateral[1],       depth,
                             next.rotation[0], next.rotation[1], turn};
    const float count = float(vertices.count);
    const float trust =
        std::fmin(1.0f, kIndependent / std::fmax(count, 1.0f)) / (kModelErrorMm * kModelErrorMm);
    const float looseness = motionLooseness(image);
    AlignmentBatch batch{
        .row = {}, .distance = vertices.distance.data(), .count = int(vertices.distance.size())};
    for (int k = 0; k < 6; ++k) batch.row[k] = vertices.row[k].data();
    float scale = 0;
    for (int step = 0; step < kSteps; ++step) {
        Equations equations;
        SixSums sums;
        kernels().sumAlignment(batch, motion, scale > 0 ? 1 / (kCut * scale) : 0.0f, sums);
        equations.addSums(sums.products, sums.right);
        equations.scale(trust);
        const float x = centre.x / centre.z;
        const float y = centre.y / centre.z;
        const float shift_weight = weightOf(kImageShiftMm);
        const float depth_weight = weightOf(kImageDepthMm * looseness);
        const float turn_weight = weightOf(kImageTurnRad * looseness);
        const float step_weight = weightOf(kTurnStepRad * looseness);
        equations.add({1, 0, -x, 0, 0, 0}, lateral[0], shift_weight);
        equations.add({0, 1, -y, 0, 0, 0}, lateral[1], shift_weight);
        equations.add({0, 0, 1, 0, 0, 0}, depth, depth_weight);
        equations.add({0, 0, 0, 1, 0, 0}, next.rotation[0], step_weight);
        equations.add({0, 0, 0, 0, 1, 0}, next.rotation[1], step_weight);
        equations.add({0, 0, 0, 0, 0, 1}, turn, turn_weight);
        const Equations::Vector before = motion;
        if (!equations.solve(motion)) return {{lateral[0], lateral[1], depth}, {0, 0, turn}};
        if (count > 0) scale = sums.residuals / count;
        bool settled = step > 0;  // the first step is without robust weights
        for (int k = 0; k < 6; ++k) {
            const float limit = k < 3 ? kSettledMm : kSettledRad;
            settled = settled && std::fabs(motion[k] - before[k]) < limit;
        }
        if (settled) break;
    }
    return {{motion[0], motion[1], motion[2]}, {motion[3], motion[4], motion[5]}};
}

}  // namespace

SurfaceMiddle findMiddle(const VertexGrid& grid, const PointPlanes& points) {
    double x = 0, y = 0, z = 0;
    int count = 0;
    forEachSample(grid, 0, [&](std::size_t i) {
        x += points.x[i];
        y += points.y[i];
        z += points.z[i];
        ++count;
    });
    if (count == 0) return {};
    const Point mean{float(x / count), float(y / count), float(z / count)};
    float nearest = -1;
    std::size_t middle = 0;
    forEachSample(grid, 0, [&](std::size_t i) {
        const Vector d = points[i] - mean;
        const float distance = dot(d, d);
        if (nearest >= 0 && distance >= nearest) return;
        nearest = distance;
        middle = i;
    });
    const int column = int(middle % grid.columns);
    return {int(middle / grid.columns), column, {float(column), grid.y[middle]}};
}

float millimetresPerPixel(const GridCalibration& calibration, const SurfaceMiddle& middle) {
    if (middle.code == 0) return 0;
    const Vector slope = toVector(calibration.slopeAt(middle.code, middle.column, middle.place.y));
    return std::sqrt(dot(slope, slope));
}

void findReferencePlanes(const GridCalibration& calibration, const VertexGrid& grid,
                         const PointPlanes& points, ReferencePlanes& planes) {
    planes.normal.resize(grid.size());
    planes.mm_per_px.resize(grid.size());
    planes.known.assign(grid.size(), 0);
    planes.ahead.resize(grid.columns);
    markMeasured(grid, planes.measured);
    planes.none.assign(grid.columns, 0);
    for (int code = 2; code + 1 < grid.codes; code += 2) {
        const int first = std::max(grid.extent[code].first, kReach);
        const int count = std::min(grid.extent[code].end, grid.columns - kReach) - first;
        if (count <= 0) continue;
        const std::size_t i = grid.index(code, first);
        const std::size_t row = grid.columns;
        const std::size_t above = i - row;
        const std::size_t below = i + row;
        std::uint8_t* known = planes.known.data() + i;
        const std::uint8_t* m = planes.measured.data();
        markBetween(&grid.cell[i], m + above, m + below, count, known);
        const float* y = grid.y.data() + i;
        calibration.row(code, first, count, y, 1, rowFrom(planes.ahead, 0));
        const bool has_above = code > 3;
        const bool has_below = code + 3 < grid.codes;
        const std::size_t beyond_above = has_above ? above - 2 * row : above;
        const std::size_t beyond_below = has_below ? below + 2 * row : below;
        kernels().referencePlanes(
            {.above = rowFrom(points, above),
             .below = rowFrom(points, below),
             .here = rowFrom(points, i),
             .ahead = rowFrom(planes.ahead, 0),
             .reach = kReach,
             .least_mm_per_px = kEdgeOn,
             .above_y = grid.y.data() + above,
             .below_y = grid.y.data() + below,
             .beyond_above_y = grid.y.data() + beyond_above,
             .beyond_below_y = grid.y.data() + beyond_below,
             .beyond_above = has_above ? m + beyond_above : planes.none.data(),
             .beyond_below = has_below ? m + beyond_below : planes.none.data(),
             .largest_jump = kJump,
             .largest_bend = kBend},
            count, {rowFrom(planes.normal, i), planes.mm_per_px.data() + i, known});
    }
}

SurfaceMotion estimateSurfaceMotion(const MeasuredSurface& surface,
                                    const GridCalibration& calibration, int bits,
                                    const SurfaceMiddle& middle,
                                    const std::array<ImageMotion, kMaxBits>& image_motions,
                                    AlignmentEquations& scratch) {
    SurfaceMotion motion;
    if (middle.code == 0) return motion;
    const ImageToSpace to_space(calibration, surface.grid, middle);
    motion.centre = to_space.centre();
    // The finest pair's moment is the reference; each pair's turn is near that of the next in time.
    for (int pair = bits - 2; pair >= 0; --pair) {
        collectEquations(surface, motion.centre, pair, bits, scratch);
        motion.pairs[pair] =
            alignPair(scratch, to_space, image_motions[pair], motion.pairs[pair + 1]);
    }
    return motion;
}

int compensateMotion(const MeasuredSurface& surface, const SurfaceMotion& motion, int bits,
                     VertexGrid& grid) {
    constexpr float kMoved = 0.2f;  // px
    const ReferencePlanes& planes = surface.planes;
    const BesideJump beside(surface);
    int emptied = 0;
    for (int code = 2; code + 1 < grid.codes; code += 2) {
        const auto [first, end] = grid.extent[code];
        if (first >= end) continue;
        const std::size_t row = grid.index(code, 0);
        const RigidMotion& rigid = motion.pairs[pairOfEdge(code, bits)];
        // The shifts of the whole row first; where no plane is known they are void.
        float* shifts = grid.scratch.data() + row;
        kernels().compensateRow(
            rowFrom(surface.points, row + first),
            {rowFrom(planes.normal, row + first), planes.mm_per_px.data() + row + first,
             planes.known.data() + row + first},
            {{motion.centre.x, motion.centre.y, motion.centre.z},
             rigid.translation,
             rigid.rotation},
            end - first, shifts + first);
        // Where the surface's direction is not known, the shift is that of the last cell that knew.
        float shift = 0;
        for (int column = first; column < end; ++column) {
            const std::size_t i = row + column;
            if (planes.known[i]) {
                shift = shifts[column];
            } else if (grid.cell[i] != Cell::empty) {
                beside.shiftAt(code, column, motion.centre, rigid, shift);
            }
            grid.y[i] += shift;
            if (std::fabs(shift) > kMoved && grid.cell[i] != Cell::empty &&
                beside.isOutline(code, column, grid.y[i])) {
                grid.cell[i] = Cell::empty;
                ++emptied;
            }
        }
    }
    return emptied;
}

}  // namespace facescan
