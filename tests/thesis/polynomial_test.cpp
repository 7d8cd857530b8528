#include "thesis/polynomial.h"

#include <gtest/gtest.h>

namespace facescan::thesis {
namespace {

TEST(ThesisPolynomial, TermsCountUpInTheOrderOfTheFormat) {
    // Degree 2, in order: 1, w, w², v, v w, v², u, u w, u v, u². With u = 2, v = 3, w = 5.
    Calibration calibration;
    calibration.degree = 2;
    calibration.x = {10, 0.5};
    calibration.y = {4, -1};
    calibration.code = {0, 2};
    const double terms[10] = {1, 5, 25, 3, 15, 9, 2, 10, 6, 4};
    for (int n = 0; n < 10; ++n) {
        for (auto& output : calibration.coefficients) output.assign(10, 0);
        calibration.coefficients[0][n] = 1;
        calibration.coefficients[2][n] = -2;
        const SpacePoint point = toMillimetres(calibration, {11, 1}, 10);
        EXPECT_NEAR(point.x, terms[n], 1e-12) << "term " << n;
        EXPECT_EQ(point.y, 0) << "term " << n;
        EXPECT_NEAR(point.z, -2 * terms[n], 1e-12) << "term " << n;
    }
}

}  // namespace
}  // namespace facescan::thesis
