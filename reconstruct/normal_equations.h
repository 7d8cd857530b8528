#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace facescan {

/// Normal equations of a weighted linear least-squares problem with N unknowns, summed row by row
/// and solved by Cholesky's method. The order of all operations is fixed, so that every target
/// gives the same bits; a library's vectorised sums would not.
template <typename Scalar, int N>
class NormalEquations {
public:
    using Vector = std::array<Scalar, N>;

    /// Adds the equation row · unknowns = value.
    void add(const Vector& row, Scalar value, Scalar weight) {
        for (int i = 0; i < N; ++i) {
            const Scalar weighted = weight * row[i];
            for (int j = 0; j <= i; ++j) matrix_[i][j] += weighted * row[j];
            right_[i] += weighted * value;
        }
    }

    /// Adds to the right-hand side alone what add() would add there with weight 1.
    void addRight(const Vector& row, Scalar value) {
        for (int i = 0; i < N; ++i) right_[i] += row[i] * value;
    }

    /// Adds the sums over many equations at once: of the products of their coefficients, the lower
    /// triangle row by row, and of coefficient times value.
    void addSums(const std::array<Scalar, N*(N + 1) / 2>& products, const Vector& right) {
        int n = 0;
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j <= i; ++j, ++n) matrix_[i][j] += products[n];
            right_[i] += right[i];
        }
    }

    /// Adds all equations of another set.
    void add(const NormalEquations& other) {
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j <= i; ++j) matrix_[i][j] += other.matrix_[i][j];
            right_[i] += other.right_[i];
        }
    }

    /// Multiplies the weights of all equations.
    void scale(Scalar factor) {
        for (Vector& row : matrix_) {
            for (Scalar& value : row) value *= factor;
        }
        for (Scalar& value : right_) value *= factor;
    }

    /// Adds `amount` × unknown² to the sum of squares: pulls the unknown towards zero.
    void damp(int unknown, Scalar amount) { matrix_[unknown][unknown] += amount; }

    /// Solves for the unknowns; false where the equations do not determine them.
    bool solve(Vector& unknowns) const {
        std::array<Vector, N> lower;
        Vector inverse;  // of the diagonal
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j < i; ++j) {
                Scalar sum = matrix_[i][j];
                for (int k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
                lower[i][j] = sum * inverse[j];
            }
            Scalar sum = matrix_[i][i];
            for (int k = 0; k < i; ++k) sum -= lower[i][k] * lower[i][k];
            if (!(sum > kSingular * matrix_[i][i])) return false;
            inverse[i] = 1 / std::sqrt(sum);
        }
        for (int i = 0; i < N; ++i) {
            Scalar sum = right_[i];
            for (int k = 0; k < i; ++k) sum -= lower[i][k] * unknowns[k];
            unknowns[i] = sum * inverse[i];
        }
        for (int i = N - 1; i >= 0; --i) {
            Scalar sum = unknowns[i];
            for (int k = i + 1; k < N; ++k) sum -= lower[k][i] * unknowns[k];
            unknowns[i] = sum * inverse[i];
        }
        return true;
    }

private:
    /// A pivot smaller than this share of its diagonal element is rounding.
    static constexpr Scalar kSingular = 32 * std::numeric_limits<Scalar>::epsilon();

    std::array<Vector, N> matrix_{};  ///< the lower triangle
    Vector right_{};
};

}  // namespace facescan
