#include "reconstruct/pinhole_scanner.h"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace facescan::test {
namespace {

using Eigen::Vector3d;

/// Swaps x and y, which turns a scanner with stripes along rows into one with stripes along
/// columns.
Vector3d turned(const Vector3d& p, CodeAxis axis) {
    return axis == CodeAxis::y ? p : Vector3d(p.y(), p.x(), p.z());
}

/// u^i v^j w^k in the order of the bundle format.
std::vector<double> monomials(int degree, double u, double v, double w) {
    std::vector<double> terms;
    for (int i = 0; i <= degree; ++i) {
        for (int j = 0; j <= degree - i; ++j) {
            for (int k = 0; k <= degree - i - j; ++k) {
                terms.push_back(std::pow(u, i) * std::pow(v, j) * std::pow(w, k));
            }
        }
    }
    return terms;
}

}  // namespace

Vector3d PinholeScanner::ray(double x, double y) const {
    return {(x - 0.5 * (width - 1)) / focal_px, (y - 0.5 * (height - 1)) / focal_px, 1};
}

Eigen::Vector2d PinholeScanner::project(const Vector3d& point) const {
    return {focal_px * point.x() / point.z() + 0.5 * (width - 1),
            focal_px * point.y() / point.z() + 0.5 * (height - 1)};
}

double PinholeScanner::codeOf(const Vector3d& point) const {
    constexpr double kBaseline = 120;
    constexpr double kAimedAt = 400;
    const Vector3d p = turned(point, axis);
    const double length = std::hypot(kBaseline, kAimedAt);
    const double sine = kBaseline / length;
    const double cosine = kAimedAt / length;
    const double along = cosine * (p.y() + kBaseline) - sine * p.z();
    const double depth = sine * (p.y() + kBaseline) + cosine * p.z();
    const double stripes = stripes_per_radian * along / depth;
    return (1 << (bits - 1)) + (rising ? stripes : -stripes);
}

ScanDescription PinholeScanner::describe(FrameOrder order, double min_mm, double max_mm) const {
    ScanDescription scan;
    scan.image = {0, 0, width, height};
    scan.pattern = {bits, axis, order};
    Calibration& calibration = scan.calibration;
    calibration.degree = 5;
    calibration.x = {0.5 * (width - 1), 0.5 * width};
    calibration.y = {0.5 * (height - 1), 0.5 * height};
    const double half_range = 1 << (bits - 1);
    calibration.code = {half_range, 0.25 * half_range};
    calibration.range_min_mm = min_mm;
    calibration.range_max_mm = max_mm;

    constexpr int kSteps = 9;
    const int terms = polynomialTerms(calibration.degree);
    Eigen::MatrixXd rows(kSteps * kSteps * kSteps, terms);
    Eigen::MatrixXd points(rows.rows(), 3);
    for (int n = 0; n < rows.rows(); ++n) {
        const auto part = [](int step) { return double(step) / (kSteps - 1); };
        const double x = part(n % kSteps) * (width - 1);
        const double y = part(n / kSteps % kSteps) * (height - 1);
        const double z = min_mm + part(n / kSteps / kSteps) * (max_mm - min_mm);
        const Vector3d point = z * ray(x, y);
        const std::vector<double> row =
            monomials(calibration.degree, calibration.x(x), calibration.y(y),
                      calibration.code(codeOf(point)));
        rows.row(n) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), terms);
        points.row(n) = point.transpose();
    }
    const Eigen::MatrixXd solution = rows.householderQr().solve(points);
    for (int output = 0; output < 3; ++output) {
        const Eigen::VectorXd column = solution.col(output);
        calibration.coefficients[output].assign(column.data(), column.data() + terms);
    }
    return scan;
}

Surface planeSurface(double depth, double slope_x, double slope_y) {
    return [=](const Vector3d& ray) { return depth / (1 - slope_x * ray.x() - slope_y * ray.y()); };
}

Surface sphereSurface(const Vector3d& centre, double radius) {
    return [=](const Vector3d& ray) {
        // |t ray − centre| = radius, the nearer solution.
        const double a = ray.squaredNorm();
        const double b = ray.dot(centre);
        return (b - std::sqrt(b * b - a * (centre.squaredNorm() - radius * radius))) / a;
    };
}

StripedScene sceneOf(const PinholeScanner& scanner, const Surface& surface) {
    StripedScene scene;
    scene.code = [=](double x, double y) {
        const Vector3d ray = scanner.ray(x, y);
        return scanner.codeOf(surface(ray) * ray);
    };
    return scene;
}

}  // namespace facescan::test
