#include "thesis/thesis_pipeline.h"

#include <gmock/gmock.h>

#include <cmath>

#include "capture/bundle.h"

namespace facescan::thesis {
namespace {

/// The recorded plane: 320 mm away, tilted by 3° and 5° (truth/plane_near/surface.npz).
class ThesisPipeline : public testing::Test {
protected:
    static void SetUpTestSuite() {
        bundle = readBundle(TEST_DATA_DIR "/plane_near");
        result = reconstruct(bundle.frames.view(), bundle.description);
    }

    static double heightAbovePlane(const Vertex& vertex) {
        const double slope_x = std::tan(3 * M_PI / 180);
        const double slope_y = -std::tan(5 * M_PI / 180);
        const double depth = 320 + slope_x * vertex.x + slope_y * vertex.y;
        return (depth - vertex.z) / std::hypot(slope_x, slope_y, 1.0);
    }

    static inline ScanBundle bundle;
    static inline Result result;
};

TEST_F(ThesisPipeline, MeasuresAPlaneAsWellAsWholePixelsCan) {
    // A pixel is z² / (f · b) = 320² / (1140 · 120) mm of depth; an edge lies anywhere in it.
    const double of_rounding = 320.0 * 320 / (1140 * 120) / std::sqrt(12);
    double sum = 0;
    double sum_of_squares = 0;
    for (const Vertex& vertex : result.mesh.vertices) {
        const double height = heightAbovePlane(vertex);
        sum += height;
        sum_of_squares += height * height;
    }
    const auto count = double(result.mesh.vertices.size());
    EXPECT_LT(std::abs(sum / count), 0.1 * of_rounding);
    EXPECT_NEAR(std::sqrt(sum_of_squares / count), of_rounding, 0.1 * of_rounding);
}

TEST_F(ThesisPipeline, CoversWhatTheProjectorLights) {
    float left = 1;
    float right = 0;
    for (const Vertex& vertex : result.mesh.vertices) {
        left = std::min(left, vertex.s);
        right = std::max(right, vertex.s);
    }
    EXPECT_LT(left, 0.03f);
    EXPECT_GT(right, 0.97f);
    // In a closed triangulation there are two faces a vertex.
    EXPECT_GT(double(result.mesh.triangles.size()), 1.9 * double(result.mesh.vertices.size()));
}

TEST_F(ThesisPipeline, AStillSceneIsNotShifted) {
    EXPECT_THAT(result.shifts_px, testing::Each(0));
}

TEST_F(ThesisPipeline, TheTextureCoversTheImageRectangle) {
    EXPECT_EQ(result.texture.width, bundle.description.image.width);
    EXPECT_EQ(result.texture.height, bundle.description.image.height);
}

}  // namespace
}  // namespace facescan::thesis
