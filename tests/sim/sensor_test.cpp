#include "sim/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random.h"

namespace facescan::sim {
namespace {

TEST(Sensor, ReportsTheExpectedGreyRoundedWhenQuiet) {
    const Sensor quiet{
        .gain = 100, .pedestal = 5, .electrons_per_level = 0, .read_noise_levels = 0};
    EXPECT_EQ(expectedGrey(quiet, 0.5), 55);
    EXPECT_EQ(expose(quiet, 55.4, 1), 55);
    EXPECT_EQ(expose(quiet, 55.6, 1), 56);
}

TEST(Sensor, SaturatesAtBothEnds) {
    const Sensor quiet{.electrons_per_level = 0, .read_noise_levels = 0};
    EXPECT_EQ(expose(quiet, 400, 1), 255);
    EXPECT_EQ(expose(quiet, -20, 1), 0);
}

TEST(Sensor, NoiseIsShotPlusRead) {
    const Sensor sensor{
        .gain = 265, .pedestal = 2, .electrons_per_level = 10, .read_noise_levels = 2};
    EXPECT_DOUBLE_EQ(noiseVariance(sensor, 102), 100.0 / 10 + 4);
    EXPECT_DOUBLE_EQ(noiseVariance(sensor, 1), 4) << "there is no negative signal";
}

TEST(Sensor, ReportedLevelsHaveTheModelsVariance) {
    const Sensor sensor{
        .gain = 265, .pedestal = 2, .electrons_per_level = 10, .read_noise_levels = 2};
    const double expected = 120.3;
    const int count = 100000;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double off = expose(sensor, expected, hashed(3, i)) - expected;
        sum += off;
        squares += off * off;
    }
    const double rounding = 1.0 / 12;
    const double variance = noiseVariance(sensor, expected) + rounding;
    EXPECT_NEAR(sum / count, 0, 4 * std::sqrt(variance / count));
    EXPECT_NEAR(squares / count, variance, 4 * variance * std::sqrt(2.0 / count));
}

}  // namespace
}  // namespace facescan::sim
