#include "sim/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace facescan::sim {
namespace {

TEST(Random, DependsOnEveryCounter) {
    EXPECT_NE(hashed(1, 2, 3), hashed(0, 2, 3));
    EXPECT_NE(hashed(1, 2, 3), hashed(1, 0, 3));
    EXPECT_NE(hashed(1, 2, 3), hashed(1, 2, 0));
    EXPECT_NE(hashed(1, 2), hashed(2, 1));
}

TEST(Random, UniformStaysInsideItsInterval) {
    EXPECT_GT(uniform(0), 0);
    EXPECT_LT(uniform(~std::uint64_t(0)), 1);
}

TEST(Random, QuantileInvertsTheNormalDistribution) {
    for (const double x : {-5.0, -3.0, -2.0, -1.0, -0.1, 0.0, 0.5, 1.5, 2.5, 4.5}) {
        const double share = 0.5 * std::erfc(-x / std::sqrt(2.0));
        EXPECT_NEAR(normalQuantile(share), x, 1e-7) << x;
    }
}

TEST(Random, GaussianHasTheMomentsOfTheStandardNormal) {
    const int count = 400000;
    double sum = 0, squares = 0, fourth = 0;
    for (int i = 0; i < count; ++i) {
        const double g = gaussian(hashed(7, i));
        sum += g;
        squares += g * g;
        fourth += g * g * g * g;
    }
    EXPECT_NEAR(sum / count, 0, 4 / std::sqrt(double(count)));
    EXPECT_NEAR(squares / count, 1, 4 * std::sqrt(2.0 / count));
    EXPECT_NEAR(fourth / count, 3, 4 * std::sqrt(96.0 / count));
}

TEST(Random, ShareBelowIsTheNormalDistribution) {
    EXPECT_FLOAT_EQ(normalShareBelow(0), 0.5f);
    EXPECT_NEAR(normalShareBelow(1), 0.8413447f, 1e-6);
    EXPECT_NEAR(normalShareBelow(-2), 0.0227501f, 1e-6);
}

}  // namespace
}  // namespace facescan::sim
