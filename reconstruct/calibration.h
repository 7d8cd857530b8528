#pragma once

#include <array>
#include <vector>

namespace facescan {

/// The number of monomials u^i v^j w^k with i + j + k ≤ degree: 56 for degree 5.
constexpr int polynomialTerms(int degree) {
    return (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

/// One input of the calibration, brought near −1 … 1: (value − offset) / scale.
struct NormalisedInput {
    double offset = 0;
    double scale = 1;  ///< not zero; may be negative

    double operator()(double value) const { return (value - offset) / scale; }

    friend bool operator==(const NormalisedInput&, const NormalisedInput&) = default;
};

/// Maps a decoded stripe edge (x, y, code) to millimetres in the scanner's frame: origin at the
/// camera's centre, X right, Y down, Z out of the lens (bundle format, "calibration").
///
/// Each output is Σ a[n] u^i v^j w^k for i in 0…d, j in 0…d−i, k in 0…d−i−j, n counting up in that
/// order; u, v, w are the normalised x (px), y (px) and code (stripes).
struct Calibration {
    int degree = 5;  ///< 1 … 5
    NormalisedInput x;
    NormalisedInput y;
    NormalisedInput code;
    std::array<std::vector<double>, 3> coefficients;  ///< X, Y, Z: polynomialTerms(degree) each
    double range_min_mm = 0;  ///< a vertex whose Z lies outside the range is discarded
    double range_max_mm = 0;

    friend bool operator==(const Calibration&, const Calibration&) = default;
};

}  // namespace facescan
