#include "reconstruct/calibrate.h"

#include <algorithm>

#include "reconstruct/kernels/form.h"

namespace facescan {
namespace {

constexpr int termsOf(int degree) {
    return (degree + 1) * (degree + 2) / 2;
}

/// Where the coefficient of y^j w^k stands: by power of y, and for each by power of the code, both
/// from the highest down.
int termIndex(int degree, int j, int k) {
    const int lower = degree - j;  // powers of y above this one
    return lower * (lower + 1) / 2 + (degree - j - k);
}

/// Empties the cells without a mark. @returns how many were not empty
FACESCAN_KERNEL int emptyOthers(const std::uint8_t* __restrict marks, int count,
                                Cell* __restrict cell) {
    int emptied = 0;
    for (int x = 0; x < count; ++x) emptied += cell[x] != Cell::empty && !marks[x];
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) cell[x] = marks[x] ? cell[x] : Cell::empty;
    return emptied;
}

}  // namespace

void GridCalibration::prepare(const ScanDescription& scan, int columns, bool recover_device) {
    if (scan_ == scan && column_count_ == columns && recover_device_ == recover_device) return;
    scan_ = scan;
    column_count_ = columns;
    recover_device_ = recover_device;

    const Calibration& calibration = scan.calibration;
    turned_ = scan.pattern.axis == CodeAxis::x;
    across_ = turned_ ? calibration.y : calibration.x;
    along_ = turned_ ? calibration.x : calibration.y;
    across_.offset -= turned_ ? scan.image.y : scan.image.x;
    along_.offset -= turned_ ? scan.image.x : scan.image.y;
    columns_.resize(columns);
    for (int column = 0; column < columns; ++column) columns_[column] = float(across_(column));
    device_ = recover_device ? recoverDevice(scan) : std::nullopt;
    places_in_range_.clear();
    if (!device_) {
        tabulatePolynomials();
    } else if (calibration.range_min_mm > 0) {
        findPlacesInRange();
    }
}

void GridCalibration::findPlacesInRange() {
    const Calibration& calibration = scan_->calibration;
    const int codes = scan_->pattern.stripes();
    const int blocks = PlaceRanges::blocksOf(column_count_);
    places_in_range_.resize(codes, column_count_);
    for (int code = 1; code < codes; ++code) {
        const double w = calibration.code(code);
        // The place, normalised, at which the edge has a depth: by the secant method, for along a
        // column 1/Z is a line, but for the lens' distortion.
        const auto placeAt = [&](double u, double depth) {
            const auto excess = [&](double v) {
                return 1 / (turned_ ? device_->at(v, u, w) : device_->at(u, v, w))[2] - 1 / depth;
            };
            double v0 = -0.5;
            double v1 = 0.5;
            double e0 = excess(v0);
            for (int step = 0; step < 4; ++step) {
                const double e1 = excess(v1);
                if (e1 == e0) break;
                const double v2 = v1 - e1 * (v1 - v0) / (e1 - e0);
                v0 = v1;
                e0 = e1;
                v1 = v2;
            }
            return float(v1 * along_.scale + along_.offset);
        };
        constexpr float kMarginPx = 2;
        PlaceRanges::Range before{};
        for (int node = 0; node <= blocks; ++node) {
            const double u = across_(std::min(node * PlaceRanges::kColumns, column_count_ - 1));
            const float nearest = placeAt(u, calibration.range_min_mm);
            const float farthest = placeAt(u, calibration.range_max_mm);
            const PlaceRanges::Range here{std::min(nearest, farthest) - kMarginPx,
                                          std::max(nearest, farthest) + kMarginPx};
            if (node > 0) {
                places_in_range_.at(code, node - 1) = {std::min(before.first, here.first),
                                                       std::max(before.last, here.last)};
            }
            before = here;
        }
    }
}

void GridCalibration::tabulatePolynomials() {
    const Calibration& calibration = scan_->calibration;
    const int degree = calibration.degree;
    const int term_count = termsOf(degree);
    terms_.assign(std::size_t(3) * term_count * column_count_, 0.0f);
    for (int column = 0; column < column_count_; ++column) {
        const double u = across_(column);
        std::array<double, kMaxDegree + 1> powers{1};
        for (int i = 1; i <= degree; ++i) powers[i] = powers[i - 1] * u;
        for (int output = 0; output < 3; ++output) {
            std::array<double, termsOf(kMaxDegree)> sums{};
            int n = 0;
            for (int i = 0; i <= degree; ++i) {
                for (int j = 0; j <= degree - i; ++j) {
                    for (int k = 0; k <= degree - i - j; ++k, ++n) {
                        sums[termIndex(degree, turned_ ? i : j, k)] +=
                            calibration.coefficients[output][n] * powers[turned_ ? j : i];
                    }
                }
            }
            for (int term = 0; term < term_count; ++term) {
                terms_[(std::size_t(output) * term_count + term) * column_count_ + column] =
                    float(sums[term]);
            }
        }
    }
}

void GridCalibration::row(int code, int first, int count, const float* y, float shift,
                          const PointRow& points) const {
    const EdgeRow edges{columns_.data() + first, y, shift, float(along_.offset),
                        float(1 / along_.scale)};
    const float w = float(scan_->calibration.code(code));
    if (!device_) {
        const int degree = scan_->calibration.degree;
        const PolynomialRow polynomial{degree, w, terms_.data() + first, column_count_,
                                       std::ptrdiff_t(termsOf(degree)) * column_count_};
        kernels().polynomialRow(polynomial, edges, count, points);
        return;
    }
    const DeviceModel& d = *device_;
    const auto ray = [&](const std::array<double, 3>& r) {
        return std::array{float(r[turned_ ? 1 : 0]), float(r[turned_ ? 0 : 1]), float(r[2])};
    };
    const auto plane = [&](int k) { return float(d.edge[k] + w * d.edge_per_code[k]); };
    const DeviceRow device{.ray_x = ray(d.ray_x),
                           .ray_y = ray(d.ray_y),
                           .radial = {float(d.radial[0]), float(d.radial[1]), float(d.radial[2])},
                           .tangential = {float(d.tangential[0]), float(d.tangential[1])},
                           .plane = {plane(0), plane(1), plane(2)},
                           .plane_distance = float(1 + w * d.offset_per_code)};
    kernels().deviceRow(device, edges, count, points);
}

Point GridCalibration::at(int code, int column, float y) const {
    Point point;
    row(code, column, 1, &y, 0, {&point.x, &point.y, &point.z});
    return point;
}

Point GridCalibration::slopeAt(int code, int column, float y) const {
    const Point after = at(code, column, y + 0.5f);
    const Point before = at(code, column, y - 0.5f);
    return {after.x - before.x, after.y - before.y, after.z - before.z};
}

void calibrateCells(const GridCalibration& calibration, const VertexGrid& grid,
                    PointPlanes& points) {
    points.resize(grid.size() + VertexGrid::kBeyond);
    for (int code = 1; code < grid.codes; ++code) {
        const auto [first, end] = grid.extent[code];
        if (first >= end) continue;
        const std::size_t i = grid.index(code, first);
        calibration.row(code, first, end - first, grid.y.data() + i, 0, rowFrom(points, i));
    }
}

void calibrateFilledCells(const GridCalibration& calibration, const VertexGrid& grid,
                          PointPlanes& points) {
    for (int code = 1; code < grid.codes; ++code) {
        for (int column = grid.extent[code].first; column < grid.extent[code].end; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] != Cell::filled) continue;
            points.set(i, calibration.at(code, column, grid.y[i]));
        }
    }
}

int rejectOutOfRange(const Calibration& calibration, const PointPlanes& points,
                     std::vector<std::uint8_t>& inside, VertexGrid& grid) {
    int emptied = 0;
    inside.resize(grid.columns);
    for (int code = 1; code < grid.codes; ++code) {
        const auto [first, end] = grid.extent[code];
        if (first >= end) continue;
        const std::size_t i = grid.index(code, first);
        kernels().markInRange(&points.z[i], float(calibration.range_min_mm),
                              float(calibration.range_max_mm), end - first, inside.data());
        emptied += emptyOthers(inside.data(), end - first, &grid.cell[i]);
    }
    return emptied;
}

}  // namespace facescan
