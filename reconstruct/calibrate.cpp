#include "reconstruct/calibrate.h"

namespace facescan {
namespace {

using Outputs = GridCalibration::Outputs;

/// sum · x + c, for all outputs side by side.
void multiplyAdd(Outputs& sum, float x, const Outputs& c) {
    for (std::size_t output = 0; output < sum.size(); ++output) {
        sum[output] = sum[output] * x + c[output];
    }
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
    device_ = recover_device ? recoverDevice(scan) : std::nullopt;
    if (!device_) tabulatePolynomials();
}

void GridCalibration::tabulatePolynomials() {
    const Calibration& calibration = scan_->calibration;
    const int degree = calibration.degree;
    columns_.assign(column_count_, ColumnTable{});
    for (int column = 0; column < column_count_; ++column) {
        const double u = across_(column);
        std::array<double, kMaxDegree + 1> powers{1};
        for (int i = 1; i <= degree; ++i) powers[i] = powers[i - 1] * u;
        for (int output = 0; output < 3; ++output) {
            std::array<double, 21> sums{};
            int n = 0;
            for (int i = 0; i <= degree; ++i) {
                for (int j = 0; j <= degree - i; ++j) {
                    for (int k = 0; k <= degree - i - j; ++k, ++n) {
                        sums[termIndex(turned_ ? i : j, k)] +=
                            calibration.coefficients[output][n] * powers[turned_ ? j : i];
                    }
                }
            }
            for (int term = 0; term < 21; ++term) {
                columns_[column][term][output] = float(sums[term]);
            }
        }
    }
}

GridCalibration::Line GridCalibration::line(int code, int column) const {
    Line line;
    line.calibration_ = this;
    line.across_ = float(across_(column));
    line.code_ = float(scan_->calibration.code(code));
    if (device_) return line;
    const ColumnTable& table = columns_[column];
    const int degree = scan_->calibration.degree;
    for (int j = 0; j <= degree; ++j) {
        Outputs sum{};
        for (int k = degree - j; k >= 0; --k) {
            multiplyAdd(sum, line.code_, table[termIndex(j, k)]);
        }
        line.coefficients_[j] = sum;
    }
    return line;
}

Point GridCalibration::Line::at(float y) const {
    const GridCalibration& c = *calibration_;
    const float along = (y - float(c.along_.offset)) * float(1 / c.along_.scale);
    if (c.device_) {
        const auto p =
            c.turned_ ? c.device_->at(along, across_, code_) : c.device_->at(across_, along, code_);
        return {p[0], p[1], p[2]};
    }
    Outputs sum{};
    for (int j = c.scan_->calibration.degree; j >= 0; --j)
        multiplyAdd(sum, along, coefficients_[j]);
    return {sum[0], sum[1], sum[2]};
}

Point GridCalibration::Line::slopeAt(float y) const {
    const Point after = at(y + 0.5f);
    const Point before = at(y - 0.5f);
    return {after.x - before.x, after.y - before.y, after.z - before.z};
}

void calibrateCells(const GridCalibration& calibration, const VertexGrid& grid,
                    std::vector<Point>& points, std::vector<Point>* slopes) {
    points.resize(grid.size());
    if (slopes) slopes->resize(grid.size());
    for (int code = 1; code < grid.codes; ++code) {
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] == Cell::empty) continue;
            const GridCalibration::Line line = calibration.line(code, column);
            points[i] = line.at(grid.y[i]);
            if (slopes) (*slopes)[i] = line.slopeAt(grid.y[i]);
        }
    }
}

void calibrateFilledCells(const GridCalibration& calibration, const VertexGrid& grid,
                          std::vector<Point>& points) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid.cell[i] != Cell::filled) continue;
        const int code = int(i / grid.columns);
        const int column = int(i % grid.columns);
        points[i] = calibration.line(code, column).at(grid.y[i]);
    }
}

int rejectOutOfRange(const Calibration& calibration, const std::vector<Point>& points,
                     VertexGrid& grid) {
    int emptied = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid.cell[i] == Cell::empty) continue;
        const float z = points[i].z;
        if (z >= float(calibration.range_min_mm) && z <= float(calibration.range_max_mm)) continue;
        grid.cell[i] = Cell::empty;
        ++emptied;
    }
    return emptied;
}

}  // namespace facescan
