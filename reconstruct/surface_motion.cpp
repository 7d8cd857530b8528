#include "reconstruct/surface_motion.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

using Vector = std::array<float, 3>;

Vector operator-(const Point& a, const Point& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator+(const Vector& a, const Vector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
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

/// The finest pair's surface beside a cell of another pair.
struct ReferencePlane {
    Vector normal;    ///< unit
    float mm_per_px;  ///< along the normal, for a pixel of the edge's place
};

/// Looks up the finest pair's surface in the rows above and below, which are its own.
class ReferenceSurface {
public:
    explicit ReferenceSurface(const MeasuredSurface& surface)
        : grid_(surface.grid), points_(surface.points), slopes_(surface.slopes) {}

    /// The plane at a cell; false where too little is known around it, or it is seen edge on.
    bool planeAt(int code, int column, ReferencePlane& plane) const {
        // Far enough apart to average the noise, near enough to follow a face.
        constexpr int kReach = 4;
        if (column < kReach || column + kReach >= grid_.columns) return false;
        const std::size_t above = grid_.index(code - 1, column);
        const std::size_t below = grid_.index(code + 1, column);
        for (const std::size_t i : {above, below}) {
            if (!measured(i) || !measured(i - kReach) || !measured(i + kReach)) return false;
        }
        const Vector along = (points_[above + kReach] - points_[above - kReach]) +
                             (points_[below + kReach] - points_[below - kReach]);
        const Vector across = (points_[below] - points_[above]) +
                              (points_[below + kReach] - points_[above + kReach]) +
                              (points_[below - kReach] - points_[above - kReach]);
        plane.normal = cross(along, across);
        const float length = std::sqrt(dot(plane.normal, plane.normal));
        if (!(length > 0)) return false;
        for (float& n : plane.normal) n /= length;
        plane.mm_per_px = dot(plane.normal, toVector(slopes_[grid_.index(code, column)]));
        constexpr float kEdgeOn = 0.15f;
        return std::fabs(plane.mm_per_px) > kEdgeOn;
    }

    /// Where the finest pair's surface crosses the edge's line: a cubic through the rows around.
    float placeAt(int code, int column) const {
        const std::size_t i = grid_.index(code, column);
        const std::size_t row = grid_.columns;
        const float near = grid_.y[i - row] + grid_.y[i + row];
        const bool wide =
            code >= 4 && code + 3 < grid_.codes && measured(i - 3 * row) && measured(i + 3 * row);
        if (!wide) return 0.5f * near;
        const float far = grid_.y[i - 3 * row] + grid_.y[i + 3 * row];
        return (9 * near - far) * (1.0f / 16.0f);
    }

private:
    bool measured(std::size_t i) const { return grid_.cell[i] == Cell::measured; }

    const VertexGrid& grid_;
    const std::vector<Point>& points_;
    const std::vector<Point>& slopes_;
};

/// The motion of the face at its middle that the motion of its image shows.
class ImageToSpace {
public:
    ImageToSpace(const GridCalibration& calibration, const VertexGrid& grid,
                 const SurfaceMiddle& middle) {
        const float y = middle.place.y;
        centre_ = calibration.line(middle.code, middle.column).at(y);
        const Point next_y = calibration.line(middle.code, middle.column).at(y + 1);
        const int side = middle.column + 1 < grid.columns ? 1 : -1;
        const Point next_column = calibration.line(middle.code, middle.column + side).at(y);
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

/// The equations of a pair's vertices.
void collectEquations(const MeasuredSurface& measured, const Point& centre, int pair, int bits,
                      std::vector<AlignmentEquation>& equations) {
    constexpr int kSpacing = 3;  // neighbouring columns say nearly the same
    const VertexGrid& grid = measured.grid;
    const ReferenceSurface surface(measured);
    const int step = 1 << (bits - 1 - pair);
    equations.clear();
    for (int code = step; code + 1 < grid.codes; code += 2 * step) {
        for (int column = code / step % kSpacing; column < grid.columns; column += kSpacing) {
            const std::size_t i = grid.index(code, column);
            ReferencePlane plane;
            if (grid.cell[i] != Cell::measured || !surface.planeAt(code, column, plane)) continue;
            const Vector& n = plane.normal;
            const Vector lever = cross(measured.points[i] - centre, n);
            equations.push_back(
                {.row = {n[0], n[1], n[2], lever[0], lever[1], lever[2]},
                 .distance = (surface.placeAt(code, column) - grid.y[i]) * plane.mm_per_px});
        }
    }
}

/// Tukey's weight of a residual; `scale`, a mean absolute residual, is 0 where none is known yet.
float tukeyWeight(float residual, float scale) {
    constexpr float kCut = 3.5f;
    if (!(scale > 0)) return 1;
    const float u = residual / (kCut * scale);
    const float bell = 1 - u * u;
    return bell > 0 ? bell * bell : 0.0f;
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

RigidMotion alignPair(const std::vector<AlignmentEquation>& vertices, const ImageToSpace& to_space,
                      const ImageMotion& image, const RigidMotion& next) {
    constexpr int kSteps = 4;
    constexpr float kModelErrorMm = 0.05f;  // a vertex is not trusted beyond this
    constexpr float kIndependent = 1000;    // … nor are thousands of them more than this many
    constexpr int kBlock = 256;             // summed apart, so that single precision suffices
    using Equations = NormalEquations<float, 6>;

    const Point& centre = to_space.centre();
    const std::array<float, 2> lateral = to_space.undoShift(image);
    const float depth = to_space.undoScale(image);
    const float turn = to_space.undoTurn(image);
    Equations::Vector motion{lateral[0],       lateral[1],       depth,
                             next.rotation[0], next.rotation[1], turn};
    const float count = float(vertices.size());
    const float trust =
        std::fmin(1.0f, kIndependent / std::fmax(count, 1.0f)) / (kModelErrorMm * kModelErrorMm);
    const float looseness = motionLooseness(image);
    float scale = 0;
    for (int step = 0; step < kSteps; ++step) {
        Equations equations;
        double residuals = 0;
        for (std::size_t begin = 0; begin < vertices.size(); begin += kBlock) {
            Equations block;
            const std::size_t end = std::min(begin + kBlock, vertices.size());
            for (std::size_t v = begin; v < end; ++v) {
                const AlignmentEquation& vertex = vertices[v];
                float predicted = 0;
                for (int k = 0; k < 6; ++k) predicted += vertex.row[k] * motion[k];
                const float residual = std::fabs(vertex.distance - predicted);
                residuals += residual;
                block.add(vertex.row, vertex.distance, tukeyWeight(residual, scale));
            }
            equations.add(block);
        }
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
        if (!equations.solve(motion)) return {{lateral[0], lateral[1], depth}, {0, 0, turn}};
        if (count > 0) scale = float(residuals) / count;
    }
    return {{motion[0], motion[1], motion[2]}, {motion[3], motion[4], motion[5]}};
}

}  // namespace

SurfaceMiddle findMiddle(const VertexGrid& grid, const std::vector<Point>& points) {
    double x = 0, y = 0, z = 0;
    int count = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid.cell[i] != Cell::measured) continue;
        x += points[i].x;
        y += points[i].y;
        z += points[i].z;
        ++count;
    }
    if (count == 0) return {};
    const Point mean{float(x / count), float(y / count), float(z / count)};
    float nearest = -1;
    SurfaceMiddle middle;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid.cell[i] != Cell::measured) continue;
        const Vector d = points[i] - mean;
        const float distance = dot(d, d);
        if (nearest >= 0 && distance >= nearest) continue;
        nearest = distance;
        middle.code = int(i / grid.columns);
        middle.column = int(i % grid.columns);
        middle.place = {float(middle.column), grid.y[i]};
    }
    return middle;
}

float millimetresPerPixel(const GridCalibration& calibration, const SurfaceMiddle& middle) {
    if (middle.code == 0) return 0;
    const Vector slope =
        toVector(calibration.line(middle.code, middle.column).slopeAt(middle.place.y));
    return std::sqrt(dot(slope, slope));
}

SurfaceMotion estimateSurfaceMotion(const MeasuredSurface& surface,
                                    const GridCalibration& calibration, int bits,
                                    const SurfaceMiddle& middle,
                                    const std::array<ImageMotion, kMaxBits>& image_motions,
                                    std::vector<AlignmentEquation>& scratch) {
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

void compensateMotion(const MeasuredSurface& surface, const SurfaceMotion& motion, int bits,
                      VertexGrid& grid) {
    const ReferenceSurface reference(surface);
    grid.scratch = grid.y;
    for (int code = 2; code + 1 < grid.codes; code += 2) {
        const RigidMotion& rigid = motion.pairs[pairOfEdge(code, bits)];
        // Where the surface's direction is not known, the shift is that of the last cell that knew.
        float shift = 0;
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::empty) continue;
            ReferencePlane plane;
            if (reference.planeAt(code, column, plane)) {
                const Vector lever = surface.points[i] - motion.centre;
                const Vector moved = rigid.translation + cross(rigid.rotation, lever);
                shift = dot(plane.normal, moved) / plane.mm_per_px;
            }
            grid.scratch[i] = grid.y[i] + shift;
        }
    }
    grid.y.swap(grid.scratch);
}

}  // namespace facescan
