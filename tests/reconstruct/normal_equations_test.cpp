#include "reconstruct/normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace facescan {
namespace {

/// A weighted least-squares problem with rows of independent random numbers.
template <int N>
struct RandomProblem {
    static constexpr int kRows = 40;
    Eigen::Matrix<double, kRows, N> rows;
    Eigen::Matrix<double, kRows, 1> values;
    Eigen::Matrix<double, kRows, 1> weights;

    explicit RandomProblem(unsigned seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal;
        for (int r = 0; r < kRows; ++r) {
            for (int n = 0; n < N; ++n) rows(r, n) = normal(random);
            values(r) = normal(random);
            weights(r) = std::abs(normal(random));
        }
    }

    /// Minimises Σ weight (row · x − value)² + Σ damping x².
    Eigen::Matrix<double, N, 1> solve(const Eigen::Matrix<double, N, 1>& damping) const {
        Eigen::Matrix<double, kRows + N, N> stacked = Eigen::Matrix<double, kRows + N, N>::Zero();
        Eigen::Matrix<double, kRows + N, 1> right = Eigen::Matrix<double, kRows + N, 1>::Zero();
        const Eigen::Matrix<double, kRows, 1> root = weights.cwiseSqrt();
        stacked.template topRows<kRows>() = root.asDiagonal() * rows;
        stacked.template bottomRows<N>() = damping.cwiseSqrt().asDiagonal();
        right.template head<kRows>() = root.cwiseProduct(values);
        return stacked.colPivHouseholderQr().solve(right);
    }

    template <typename Scalar>
    void addTo(NormalEquations<Scalar, N>& equations, int first = 0, int last = kRows) const {
        for (int r = first; r < last; ++r) {
            std::array<Scalar, N> row;
            for (int n = 0; n < N; ++n) row[n] = Scalar(rows(r, n));
            equations.add(row, Scalar(values(r)), Scalar(weights(r)));
        }
    }
};

template <typename Scalar, int N>
void expectSolution(const NormalEquations<Scalar, N>& equations,
                    const Eigen::Matrix<double, N, 1>& expected, double tolerance) {
    std::array<Scalar, N> solution{};
    ASSERT_TRUE(equations.solve(solution));
    for (int n = 0; n < N; ++n) EXPECT_NEAR(solution[n], expected(n), tolerance);
}

TEST(NormalEquations, SolveAsEigenDoes) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const RandomProblem<6> problem(seed);
        const auto expected = problem.solve(Eigen::Matrix<double, 6, 1>::Zero());
        NormalEquations<double, 6> in_double;
        problem.addTo(in_double);
        expectSolution(in_double, expected, 1e-10);
        NormalEquations<float, 6> in_float;
        problem.addTo(in_float);
        expectSolution(in_float, expected, 1e-4);
    }
}

TEST(NormalEquations, PullADampedUnknownTowardsZero) {
    const RandomProblem<3> problem(1);
    NormalEquations<double, 3> equations;
    problem.addTo(equations);
    equations.damp(0, 2.5);
    equations.damp(2, 40.0);
    expectSolution(equations, problem.solve({2.5, 0.0, 40.0}), 1e-10);
}

TEST(NormalEquations, AddUpFromParts) {
    const RandomProblem<4> problem(2);
    NormalEquations<double, 4> first, second;
    problem.addTo(first, 0, 25);
    problem.addTo(second, 25, RandomProblem<4>::kRows);
    first.add(second);
    expectSolution(first, problem.solve(Eigen::Vector4d::Zero()), 1e-10);
}

TEST(NormalEquations, WeighScaledEquationsAgainstLaterOnes) {
    RandomProblem<3> problem(3);
    NormalEquations<double, 3> equations;
    problem.addTo(equations, 0, 30);
    equations.scale(7.0);
    problem.addTo(equations, 30, RandomProblem<3>::kRows);
    problem.weights.head<30>() *= 7.0;
    expectSolution(equations, problem.solve(Eigen::Vector3d::Zero()), 1e-10);
}

TEST(NormalEquations, TakeARightHandSideOfItsOwn) {
    RandomProblem<3> problem(4);
    problem.weights.setOnes();
    NormalEquations<double, 3> equations;
    for (int r = 0; r < problem.kRows; ++r) {
        const std::array row{problem.rows(r, 0), problem.rows(r, 1), problem.rows(r, 2)};
        equations.add(row, 0.0, 1.0);
        equations.addRight(row, problem.values(r));
    }
    expectSolution(equations, problem.solve(Eigen::Vector3d::Zero()), 1e-10);
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
