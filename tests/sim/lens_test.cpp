#include "sim/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace facescan::sim {
namespace {

TEST(Lens, WithoutBlurAPixelIsTheMeanOfItsSamples) {
    const LensFilter filter = makeLensFilter(0, 2);
    EXPECT_EQ(filter.margin_px, 0);
    const std::vector<float> samples = {1, 2, 10, 20,  //
                                        3, 6, 30, 40};
    std::vector<float> pixels(2);
    collect(filter, samples, 2, 1, pixels);
    EXPECT_FLOAT_EQ(pixels[0], 3);
    EXPECT_FLOAT_EQ(pixels[1], 25);
}

TEST(Lens, WeightsHaveTheVarianceOfTheBoxAndTheGaussian) {
    const double sigma = 0.6;
    const LensFilter filter = makeLensFilter(sigma, 16);
    double sum = 0, variance = 0;
    for (std::size_t i = 0; i < filter.weights.size(); ++i) {
        const double x = (double(i) + 0.5) / 16 - double(filter.weights.size()) / 32;
        sum += filter.weights[i];
        variance += filter.weights[i] * x * x;
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_NEAR(variance, sigma * sigma + 1.0 / 12, 0.01);
}

TEST(Lens, AnEvenSceneStaysEven) {
    const LensFilter filter = makeLensFilter(0.35, 3);
    const int width = 5, height = 4, m = filter.margin_px;
    const std::vector<float> samples((width + 2 * m) * 3 * (height + 2 * m) * 3, 0.7f);
    std::vector<float> pixels(width * height);
    collect(filter, samples, width, height, pixels);
    for (const float pixel : pixels) EXPECT_NEAR(pixel, 0.7f, 1e-5f);
}

TEST(Lens, BlursAlikeAlongBothAxes) {
    const LensFilter filter = makeLensFilter(0.5, 2);
    const int size = 7, m = filter.margin_px, row = (size + 2 * m) * 2;
    std::vector<float> samples(std::size_t(row) * row);
    for (const int dy : {0, 1}) {
        for (const int dx : {0, 1}) samples[((3 + m) * 2 + dy) * row + (3 + m) * 2 + dx] = 1;
    }
    std::vector<float> pixels(size * size);
    collect(filter, samples, size, size, pixels);
    EXPECT_NEAR(std::accumulate(pixels.begin(), pixels.end(), 0.0f), 1, 1e-5f);
    for (int i = 0; i < size; ++i) {
        EXPECT_NEAR(pixels[3 * size + i], pixels[i * size + 3], 1e-6f);
        EXPECT_NEAR(pixels[3 * size + i], pixels[3 * size + size - 1 - i], 1e-6f);
    }
    EXPECT_GT(pixels[3 * size + 3], pixels[3 * size + 2]);
    EXPECT_GT(pixels[3 * size + 2], 0.01f);
}

}  // namespace
}  // namespace facescan::sim
