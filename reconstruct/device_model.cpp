#include "reconstruct/device_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reconstruct/kernels/form.h"
#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

using Triple = std::array<double, 3>;

/// A place in the measurement volume, in normalised coordinates, and the calibration's point there.
struct Sample {
    double u, v, w;
    Triple point;
};

std::vector<double> monomials(int degree, double u, double v, double w) {
    std::vector<double> terms;
    double ui = 1;
    for (int i = 0; i <= degree; ++i, ui *= u) {
        double vj = ui;
        for (int j = 0; j <= degree - i; ++j, vj *= v) {
            double wk = vj;
            for (int k = 0; k <= degree - i - j; ++k, wk *= w) terms.push_back(wk);
        }
    }
    return terms;
}

Triple evaluate(const Calibration& calibration, double u, double v, double w) {
    const std::vector<double> terms = monomials(calibration.degree, u, v, w);
    Triple point{};
    for (int output = 0; output < 3; ++output) {
        for (std::size_t n = 0; n < terms.size(); ++n) {
            point[output] += calibration.coefficients[output][n] * terms[n];
        }
    }
    return point;
}

/// The codes between which one pixel's ray lies in the measurement range.
struct CodeRange {
    double first = 0;
    double last = 0;
    bool nearer = false;  ///< whether depth falls as the code rises
};

/// Far from the volume that it was fitted to, a polynomial can turn and enter the range again: the
/// widest stretch counts, and where `like` is given, only one along which depth changes as there.
std::optional<CodeRange> codesInRange(const Calibration& calibration, int stripes, double u,
                                      double v, const CodeRange* like) {
    constexpr int kSteps = 128;
    std::optional<CodeRange> widest;
    double begin = -1;
    double begin_depth = 0;
    double code = 0;
    double depth = 0;
    for (int step = 0; step <= kSteps + 1; ++step) {
        const double next = double(stripes) * step / kSteps;
        const double next_depth = evaluate(calibration, u, v, calibration.code(next))[2];
        const bool inside = step <= kSteps && next_depth >= calibration.range_min_mm &&
                            next_depth <= calibration.range_max_mm;
        if (inside && begin < 0) {
            begin = next;
            begin_depth = next_depth;
        }
        if (!inside && begin >= 0) {
            const CodeRange found{begin, code, depth < begin_depth};
            const bool wider = !widest || found.last - found.first > widest->last - widest->first;
            if (found.last > found.first && wider && (!like || like->nearer == found.nearer)) {
                widest = found;
            }
            begin = -1;
        }
        code = next;
        depth = next_depth;
    }
    return widest;
}

std::vector<Sample> sampleVolume(const ScanDescription& scan) {
    constexpr int kAcross = 7;
    constexpr int kDown = 9;
    constexpr int kDeep = 7;
    const Calibration& calibration = scan.calibration;
    const auto place = [](int begin, int size, int i, int count) {
        return begin + double(size - 1) * i / (count - 1);
    };
    const auto u = [&](int i) {
        return calibration.x(place(scan.image.x, scan.image.width, i, kAcross));
    };
    const auto v = [&](int j) {
        return calibration.y(place(scan.image.y, scan.image.height, j, kDown));
    };
    const int stripes = scan.pattern.stripes();
    const auto middle = codesInRange(calibration, stripes, u(kAcross / 2), v(kDown / 2), nullptr);
    std::vector<Sample> samples;
    if (!middle) return samples;
    for (int i = 0; i < kAcross; ++i) {
        for (int j = 0; j < kDown; ++j) {
            const auto codes = codesInRange(calibration, stripes, u(i), v(j), &*middle);
            if (!codes) continue;
            for (int k = 0; k < kDeep; ++k) {
                const double code = codes->first + (codes->last - codes->first) * k / (kDeep - 1);
                const double w = calibration.code(code);
                samples.push_back({u(i), v(j), w, evaluate(calibration, u(i), v(j), w)});
            }
        }
    }
    return samples;
}

/// sums[n] += factor · row[n]: sums side by side, which vectorise where one sum could not.
FACESCAN_KERNEL void addScaled(const double* __restrict row, double factor, std::size_t count,
                               double* __restrict sums) {
    for (std::size_t n = 0; n < count; ++n) sums[n] += factor * row[n];
}

/// An orthonormal basis of the polynomials over the samples, by Gram and Schmidt's method, done
/// twice.
class PolynomialSpace {
public:
    PolynomialSpace(const std::vector<Sample>& samples, int degree)
        : terms_(std::size_t(polynomialTerms(degree))), by_sample_(samples.size() * terms_) {
        std::vector<double> monomials_by_sample;
        for (const Sample& s : samples) {
            const std::vector<double> terms = monomials(degree, s.u, s.v, s.w);
            monomials_by_sample.insert(monomials_by_sample.end(), terms.begin(), terms.end());
        }
        std::vector<std::vector<double>> by_term;
        for (std::size_t n = 0; n < terms_; ++n) {
            std::vector<double> values;
            for (std::size_t s = 0; s < samples.size(); ++s) {
                values.push_back(monomials_by_sample[s * terms_ + n]);
            }
            for (int pass = 0; pass < 2; ++pass) {
                const std::vector<double> shares = project(values);
                for (std::size_t m = 0; m < n; ++m) {
                    addScaled(by_term[m].data(), -shares[m], values.size(), values.data());
                }
            }
            double square = 0;
            for (const double value : values) square += value * value;
            const double length = std::sqrt(square);
            for (std::size_t s = 0; s < samples.size(); ++s) {
                values[s] = length > 0 ? values[s] / length : 0;
                by_sample_[s * terms_ + n] = values[s];
            }
            by_term.push_back(values);
        }
    }

    /// The coordinates of a function's nearest polynomial.
    std::vector<double> project(const std::vector<double>& values) const {
        std::vector<double> coordinates(terms_);
        for (std::size_t s = 0; s < values.size(); ++s) {
            addScaled(&by_sample_[s * terms_], values[s], terms_, coordinates.data());
        }
        return coordinates;
    }

private:
    std::size_t terms_;
    std::vector<double> by_sample_;  ///< the basis at each sample, sample after sample
};

// The model's numbers in one array, for the fit.
constexpr int kParameters = 18;
using Parameters = std::array<double, kParameters>;

DeviceModel modelOf(const Parameters& p) {
    return {.ray_x = {p[0], p[1], p[2]},
            .ray_y = {p[3], p[4], p[5]},
            .radial = {p[6], p[7], p[8]},
            .tangential = {p[9], p[10]},
            .edge = {p[11], p[12], p[13]},
            .edge_per_code = {p[14], p[15], p[16]},
            .offset_per_code = p[17]};
}

/// Steps for numeric derivatives, and the scale of damping: the size at which each number matters.
constexpr Parameters kScale{0.1,  0.1,  0.1,  0.1,  0.1,  0.1,  0.1,  0.1,  0.1,
                            0.01, 0.01, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 0.1};

/// Linear fits of the undistorted rays and of the planes.
std::optional<Parameters> firstGuess(const std::vector<Sample>& samples) {
    NormalEquations<double, 3> ray_x;
    NormalEquations<double, 3> ray_y;
    NormalEquations<double, 7> planes;
    for (const Sample& s : samples) {
        const auto& [x, y, z] = s.point;
        ray_x.add({s.u, s.v, 1}, x / z, 1);
        ray_y.add({s.u, s.v, 1}, y / z, 1);
        // In decimetres the unknowns are of one size.
        const Triple p{x / 100, y / 100, z / 100};
        planes.add({p[0], p[1], p[2], s.w * p[0], s.w * p[1], s.w * p[2], -s.w}, 1, 1);
    }
    Triple x{};
    Triple y{};
    std::array<double, 7> plane{};
    if (!ray_x.solve(x) || !ray_y.solve(y) || !planes.solve(plane)) return std::nullopt;
    Parameters p{};
    for (int k = 0; k < 3; ++k) {
        p[k] = x[k];
        p[3 + k] = y[k];
        p[11 + k] = plane[k] / 100;
        p[14 + k] = plane[3 + k] / 100;
    }
    p[17] = plane[6];
    return p;
}

/// The model's deviation from the calibration, mm, by output and sample.
std::array<std::vector<double>, 3> deviation(const Parameters& p,
                                             const std::vector<Sample>& samples) {
    const DeviceModel model = modelOf(p);
    std::array<std::vector<double>, 3> difference;
    for (const Sample& s : samples) {
        const Triple point = model.at(s.u, s.v, s.w);
        for (int output = 0; output < 3; ++output) {
            difference[output].push_back(point[output] - s.point[output]);
        }
    }
    return difference;
}

/// The part of the deviation that a polynomial can express.
std::vector<double> expressible(const Parameters& p, const std::vector<Sample>& samples,
                                const PolynomialSpace& space) {
    std::vector<double> all;
    for (const std::vector<double>& difference : deviation(p, samples)) {
        const std::vector<double> part = space.project(difference);
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

double squares(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return sum;
}

/// One step of Levenberg and Marquardt's method. @returns whether it improved the fit
bool improve(Parameters& p, std::vector<double>& residual, double& damping,
             const std::vector<Sample>& samples, const PolynomialSpace& space) {
    std::array<std::vector<double>, kParameters> derivative;
    for (int k = 0; k < kParameters; ++k) {
        constexpr double kStep = 1e-5;
        Parameters moved = p;
        moved[k] += kStep * kScale[k];
        derivative[k] = expressible(moved, samples, space);
        for (std::size_t n = 0; n < residual.size(); ++n) {
            derivative[k][n] = (derivative[k][n] - residual[n]) / kStep;
        }
    }
    NormalEquations<double, kParameters> equations;
    for (std::size_t n = 0; n < residual.size(); ++n) {
        std::array<double, kParameters> row{};
        for (int k = 0; k < kParameters; ++k) row[k] = derivative[k][n];
        equations.add(row, -residual[n], 1);
    }
    constexpr int kAttempts = 6;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        NormalEquations<double, kParameters> damped = equations;
        for (int k = 0; k < kParameters; ++k) damped.damp(k, damping);
        std::array<double, kParameters> step{};
        if (damped.solve(step)) {
            Parameters moved = p;
            for (int k = 0; k < kParameters; ++k) moved[k] += kScale[k] * step[k];
            const std::vector<double> moved_residual = expressible(moved, samples, space);
            if (squares(moved_residual) < squares(residual)) {
                p = moved;
                residual = moved_residual;
                damping *= 0.1;
                return true;
            }
        }
        damping *= 10;
    }
    return false;
}

}  // namespace

std::optional<DeviceModel> recoverDevice(const ScanDescription& scan) {
    const std::vector<Sample> samples = sampleVolume(scan);
    if (samples.size() < 2 * std::size_t(polynomialTerms(scan.calibration.degree))) {
        return std::nullopt;
    }
    const std::optional<Parameters> guess = firstGuess(samples);
    if (!guess) return std::nullopt;
    const PolynomialSpace space(samples, scan.calibration.degree);
    Parameters p = *guess;
    std::vector<double> residual = expressible(p, samples, space);
    double damping = 1;
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step) {
        const double before = squares(residual);
        if (!improve(p, residual, damping, samples, space)) break;
        if (squares(residual) > 0.9999 * before) break;
    }

    double total = 0;
    for (const std::vector<double>& difference : deviation(p, samples)) {
        total += squares(difference);
    }
    const double unexplained = squares(residual);
    const double left_out = total - unexplained;
    constexpr double kLargestMm = 1.0;  // root of the mean square: beyond it nothing is explained
    const bool accepted =
        unexplained < left_out && total < kLargestMm * kLargestMm * double(samples.size());
    return accepted ? std::optional(modelOf(p)) : std::nullopt;
}

}  // namespace facescan
