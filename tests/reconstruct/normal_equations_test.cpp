#include "reconstruct/normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace facescan {
namespace {

/// A weighted least-squares problem with rows of independent random numbers.
struct RandomProblem {
    static constexpr int kRows = 40;
    Eigen::MatrixXd rows;
    Eigen::VectorXd values{kRows};
    Eigen::VectorXd weights{kRows};

    RandomProblem(int unknowns, unsigned seed) : rows(kRows, unknowns) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal;
        for (int r = 0; r < kRows; ++r) {
            for (int n = 0; n < unknowns; ++n) rows(r, n) = normal(random);
            values(r) = normal(random);
            weights(r) = std::abs(normal(random));
        }
    }

    /// Minimises Σ weight (row · x − value)² + Σ damping x².
    Eigen::VectorXd solve(const Eigen::VectorXd& damping) const {
        const Eigen::Index unknowns = rows.cols();
        Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(kRows + unknowns, unknowns);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(kRows + unknowns);
        const Eigen::VectorXd root = weights.cwiseSqrt();
        stacked.topRows(kRows) = root.asDiagonal() * rows;
        stacked.bottomRows(unknowns).diagonal() = damping.cwiseSqrt();
        right.head(kRows) = root.cwiseProduct(values);
        return stacked.colPivHouseholderQr().solve(right);
    }

    Eigen::VectorXd solve() const { return solve(Eigen::VectorXd::Zero(rows.cols())); }

    template <typename Scalar, int N>
    void addTo(NormalEquations<Scalar, N>& equations, int first = 0, int last = kRows) const {
        for (int r = first; r < last; ++r) {
            std::array<Scalar, N> row;
            for (int n = 0; n < N; ++n) row[n] = Scalar(rows(r, n));
            equations.add(row, Scalar(values(r)), Scalar(weights(r)));
        }
    }
};

template <typename Scalar, int N>
void expectSolution(const NormalEquations<Scalar, N>& equations, const Eigen::VectorXd& expected,
                    double tolerance) {
    std::array<Scalar, N> solution{};
    ASSERT_TRUE(equations.solve(solution));
    for (int n = 0; n < N; ++n) EXPECT_NEAR(solution[n], expected(n), tolerance);
}

TEST(NormalEquations, SolveAsEigenDoes) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const RandomProblem problem(6, seed);
        const Eigen::VectorXd expected = problem.solve();
        NormalEquations<double, 6> in_double;
        problem.addTo(in_double);
        expectSolution(in_double, expected, 1e-10);
        NormalEquations<float, 6> in_float;
        problem.addTo(in_float);
        expectSolution(in_float, expected, 1e-4);
    }
}

TEST(NormalEquations, PullADampedUnknownTowardsZero) {
    const RandomProblem problem(3, 1);
    NormalEquations<double, 3> equations;
    problem.addTo(equations);
    equations.damp(0, 2.5);
    equations.damp(2, 40.0);
    expectSolution(equations, problem.solve(Eigen::Vector3d(2.5, 0.0, 40.0)), 1e-10);
}

TEST(NormalEquations, AddUpFromParts) {
    const RandomProblem problem(4, 2);
    NormalEquations<double, 4> first, second;
    problem.addTo(first, 0, 25);
    problem.addTo(second, 25, RandomProblem::kRows);
    first.add(second);
    expectSolution(first, problem.solve(), 1e-10);
}

TEST(NormalEquations, WeighScaledEquationsAgainstLaterOnes) {
    RandomProblem problem(3, 3);
    NormalEquations<double, 3> equations;
    problem.addTo(equations, 0, 30);
    equations.scale(7.0);
    problem.addTo(equations, 30, RandomProblem::kRows);
    problem.weights.head(30) *= 7.0;
    expectSolution(equations, problem.solve(), 1e-10);
}

TEST(NormalEquations, TakeARightHandSideOfItsOwn) {
    RandomProblem problem(3, 4);
    problem.weights.setOnes();
    NormalEquations<double, 3> equations;
    for (int r = 0; r < problem.kRows; ++r) {
        const std::array row{problem.rows(r, 0), problem.rows(r, 1), problem.rows(r, 2)};
        equations.add(row, 0.0, 1.0);
        equations.addRight(row, problem.values(r));
    }
    expectSolution(equations, problem.solve(), 1e-10);
}

TEST(NormalEquations, RefuseWhatDoesNotDetermineTheUnknowns) {
    std::array<float, 2> solution{};
    NormalEquations<float, 2> none;
    EXPECT_FALSE(none.solve(solution));
    NormalEquations<float, 2> parallel;
    for (const float along : {1.0f, 2.0f, -3.0f}) parallel.add({along, 2 * along}, along, 1.0f);
    EXPECT_FALSE(parallel.solve(solution));
}

}  // namespace
}  // namespace facescan
