#include "thesis/polynomial.h"

#include <cmath>

namespace facescan::thesis {

SpacePoint toMillimetres(const Calibration& calibration, const PlanePoint& place, double code) {
    const double u = calibration.x(place.x);
    const double v = calibration.y(place.y);
    const double w = calibration.code(code);
    const int degree = calibration.degree;
    const auto& [for_x, for_y, for_z] = calibration.coefficients;
    SpacePoint point;
    int n = 0;
    for (int i = 0; i <= degree; ++i) {
        for (int j = 0; j <= degree - i; ++j) {
            for (int k = 0; k <= degree - i - j; ++k) {
                const double term = std::pow(u, i) * std::pow(v, j) * std::pow(w, k);
                point.x += for_x[n] * term;
                point.y += for_y[n] * term;
                point.z += for_z[n] * term;
                ++n;
            }
        }
    }
    return point;
}

}  // namespace facescan::thesis
