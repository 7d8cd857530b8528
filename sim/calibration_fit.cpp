#include "sim/calibration_fit.h"

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace facescan::sim {

namespace {

constexpr int kColumns = 25, kRows = 37, kDepths = 23;

/// An edge as the device sees it, and where it lies.
struct Correspondence {
    double x, y, code;
    Eigen::Vector3d point;
};

std::vector<Correspondence> sampleVolume(const Device& device, int stripes) {
    std::vector<Correspondence> samples;
    const Rect& image = device.image;
    const int shown = stripesShown(device.projector, stripes);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const double x = image.x + (image.width - 1) * double(column) / (kColumns - 1);
            const double y = image.y + (image.height - 1) * double(row) / (kRows - 1);
            const Eigen::Vector3d ray = device.camera.ray({x, y});
            for (int i = 0; i < kDepths; ++i) {
                const double share = double(i) / (kDepths - 1);
                const double z =
                    device.range_min_mm + (device.range_max_mm - device.range_min_mm) * share;
                const ProjectorPoint at = locate(device.projector, ray * z);
                if (at.inField()) samples.push_back({x, y, at.along * shown, ray * z});
            }
        }
    }
    return samples;
}

NormalisedInput between(double low, double high) {
    return {.offset = (low + high) / 2, .scale = (high - low) / 2};
}

Eigen::RowVectorXd monomials(const Calibration& calibration, double x, double y, double code) {
    const double u = calibration.x(x), v = calibration.y(y), w = calibration.code(code);
    Eigen::RowVectorXd terms(polynomialTerms(calibration.degree));
    int n = 0;
    double ui = 1;
    for (int i = 0; i <= calibration.degree; ++i, ui *= u) {
        double vj = ui;
        for (int j = 0; j <= calibration.degree - i; ++j, vj *= v) {
            double wk = vj;
            for (int k = 0; k <= calibration.degree - i - j; ++k, wk *= w) terms[n++] = wk;
        }
    }
    return terms;
}

FitResidual residualOf(const Eigen::MatrixXd& error) {
    FitResidual residual;
    residual.samples = int(error.rows());
    residual.rms_xyz = error.array().square().colwise().mean().sqrt().transpose();
    residual.rms = residual.rms_xyz.norm();
    residual.max = error.rowwise().norm().maxCoeff();
    return residual;
}

}  // namespace

CalibrationFit fitCalibration(const Device& device, int stripes, int degree) {
    if (degree < 1 || degree > 5) {
        throw std::invalid_argument("calibration degree " + std::to_string(degree) +
                                    ": expected 1 to 5");
    }
    const Rect& image = device.image;
    CalibrationFit fit;
    Calibration& calibration = fit.calibration;
    calibration.degree = degree;
    calibration.x = between(image.x, image.x + image.width - 1);
    calibration.y = between(image.y, image.y + image.height - 1);
    calibration.code = between(0, stripesShown(device.projector, stripes));
    calibration.range_min_mm = device.range_min_mm;
    calibration.range_max_mm = device.range_max_mm;

    const std::vector<Correspondence> samples = sampleVolume(device, stripes);
    Eigen::MatrixXd terms(samples.size(), polynomialTerms(degree));
    Eigen::MatrixXd points(samples.size(), 3);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Correspondence& s = samples[i];
        terms.row(i) = monomials(calibration, s.x, s.y, s.code);
        points.row(i) = s.point.transpose();
    }
    const auto unreachable = [&] {
        return std::invalid_argument(
            "the projector reaches too little of the measurement volume (" +
            std::to_string(samples.size()) + " of " + std::to_string(kColumns * kRows * kDepths) +
            " sample points) for a calibration of degree " + std::to_string(degree) +
            ": aim it at the range");
    };
    if (terms.rows() < terms.cols()) throw unreachable();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(terms);
    if (qr.rank() < terms.cols()) throw unreachable();
    const Eigen::MatrixXd solution = qr.solve(points);
    for (int axis = 0; axis < 3; ++axis) {
        const auto column = solution.col(axis);
        calibration.coefficients[axis].assign(column.begin(), column.end());
    }
    fit.residual = residualOf(terms * solution - points);
    return fit;
}

Eigen::Vector3d evaluate(const Calibration& calibration, double x, double y, double code) {
    const Eigen::RowVectorXd terms = monomials(calibration, x, y, code);
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& a = calibration.coefficients[axis];
        point[axis] =
            terms.dot(Eigen::Map<const Eigen::RowVectorXd>(a.data(), Eigen::Index(a.size())));
    }
    return point;
}

}  // namespace facescan::sim
