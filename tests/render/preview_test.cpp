#include "render/preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "render/meshes.h"
#include "render/render_error.h"

namespace facescan {
namespace {

using testing::append;
using ::testing::HasSubstr;
using testing::plainTexture;
using testing::quarters;
using testing::sphereCap;
using testing::squareFacingTheScanner;

/// Halves of 320 × 480, seen straight from the scanner. The margin is 5 %: a square fills the
/// columns 16 … 303 and the rows 96 … 383 of its half.
constexpr PreviewOptions kStraight{.width = 640, .height = 480, .viewpoint = {0, 0}};
constexpr int kHalf = 320;

struct Rgb {
    int r, g, b;
    int sum() const { return r + g + b; }
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

Rgb at(const RgbImage& image, int x, int y) {
    const std::uint8_t* p = image.row(y) + std::size_t{3} * x;
    return {p[0], p[1], p[2]};
}

Rgb textured(const RgbImage& image, int x, int y) {
    return at(image, x, y);
}

Rgb matte(const RgbImage& image, int x, int y) {
    return at(image, x + kHalf, y);
}

/// What an empty mesh leaves: the background.
RgbImage background(const PreviewOptions& options = kStraight) {
    return renderPreview({}, {}, options);
}

TEST(Preview, HasTheSizeAskedFor) {
    for (const auto& [width, height] :
         {std::pair(1280, 960), std::pair(2, 1), std::pair(333, 77)}) {
        const RgbImage image = renderPreview(sphereCap(80, 400), plainTexture(128),
                                             {.width = width, .height = height, .viewpoint = {}});
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        EXPECT_EQ(image.pixels.size(), 3u * width * height);
    }
}

TEST(Preview, AnEmptyMeshLeavesACalmDarkBackground) {
    const RgbImage image = background();
    for (int y = 0; y < image.height; y += 7) {
        for (int x = 0; x < kHalf; x += 5) {
            EXPECT_EQ(textured(image, x, y), matte(image, x, y));
            EXPECT_GT(at(image, x, y).sum(), 3 * 10);
            EXPECT_LT(at(image, x, y).sum(), 3 * 70);
        }
    }
}

TEST(Preview, TheTextureStandsUprightAndIsNotMirrored) {
    const RgbImage image =
        renderPreview(squareFacingTheScanner(100, 400), quarters(0, 80, 160, 240), kStraight);
    const int top_left = textured(image, 90, 170).sum();
    const int top_right = textured(image, 230, 170).sum();
    const int bottom_left = textured(image, 90, 310).sum();
    const int bottom_right = textured(image, 230, 310).sum();
    EXPECT_LT(top_left, top_right);
    EXPECT_LT(top_right, bottom_left);
    EXPECT_LT(bottom_left, bottom_right);
}

TEST(Preview, ATexturePixelCoversItsPlaceExactly) {
    const RgbImage image = renderPreview(squareFacingTheScanner(100, 400),
                                         quarters(0, 255, 0, 255, 288, 288), kStraight);
    EXPECT_EQ(textured(image, 158, 240), textured(image, 60, 240));
    EXPECT_EQ(textured(image, 161, 240), textured(image, 260, 240));
    EXPECT_GT(textured(image, 161, 240).sum(), textured(image, 158, 240).sum() + 300);
}

TEST(Preview, TheTextureDoesNotShowInTheMatteHalf) {
    const Mesh mesh = sphereCap(80, 400);
    const RgbImage black = renderPreview(mesh, plainTexture(0), kStraight);
    const RgbImage white = renderPreview(mesh, plainTexture(255), kStraight);
    EXPECT_EQ(matte(black, 160, 240), matte(white, 160, 240));
    EXPECT_NE(textured(black, 160, 240), textured(white, 160, 240));
}

TEST(Preview, TheMeshCoversItsOutlineAndNothingElse) {
    const RgbImage image =
        renderPreview(squareFacingTheScanner(100, 400), plainTexture(255), kStraight);
    const RgbImage empty = background();
    for (const auto& place : {textured, matte}) {
        for (const auto& [x, y] : {std::pair(17, 97), std::pair(302, 97), std::pair(17, 382),
                                   std::pair(302, 382), std::pair(160, 240)}) {
            EXPECT_GT(place(image, x, y).sum(), place(empty, x, y).sum() + 100) << x << ' ' << y;
        }
        for (const auto& [x, y] : {std::pair(14, 240), std::pair(305, 240), std::pair(160, 94),
                                   std::pair(160, 385), std::pair(0, 0), std::pair(319, 479)}) {
            EXPECT_EQ(place(image, x, y), place(empty, x, y)) << x << ' ' << y;
        }
    }
}

TEST(Preview, FacesTurnedAwayAreNotDrawn) {
    Mesh mesh = squareFacingTheScanner(100, 400);
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
    EXPECT_EQ(renderPreview(mesh, plainTexture(255), kStraight).pixels, background().pixels);
}

TEST(Preview, WhatIsNearHidesWhatIsFarWhateverTheOrder) {
    Mesh near_first = squareFacingTheScanner(60, 380, 1);
    append(near_first, squareFacingTheScanner(100, 400, 0));
    Mesh far_first = squareFacingTheScanner(100, 400, 0);
    append(far_first, squareFacingTheScanner(60, 380, 1));
    EXPECT_EQ(renderPreview(near_first, {}, kStraight).pixels,
              renderPreview(far_first, {}, kStraight).pixels);
}

TEST(Preview, FromTheRightTheRightSideOfASphereIsSeen) {
    const Mesh mesh = sphereCap(80, 400);
    const GreyImage texture = quarters(0, 255, 0, 255);
    PreviewOptions options = kStraight;
    options.viewpoint.right_deg = 30;
    const RgbImage image = renderPreview(mesh, texture, options);
    EXPECT_GT(textured(image, 140, 240).sum(), 3 * 128);
    options.viewpoint.right_deg = -30;
    EXPECT_LT(textured(renderPreview(mesh, texture, options), 180, 240).sum(), 3 * 128);
}

TEST(Preview, TheMatteSurfaceIsBrighterTowardsTheLight) {
    const RgbImage image = renderPreview(sphereCap(80, 400), plainTexture(128), kStraight);
    const int upper_right = matte(image, 230, 170).sum();
    const int middle = matte(image, 160, 240).sum();
    const int lower_left = matte(image, 90, 310).sum();
    EXPECT_GT(upper_right, middle + 60);
    EXPECT_GT(middle, lower_left + 60);
    EXPECT_GT(lower_left, background().pixels[0] * 3);
}

TEST(Preview, ATiltOfADegreeShowsInTheMatteHalf) {
    const auto brightness = [](float degrees) {
        Mesh mesh = squareFacingTheScanner(100, 400);
        for (Vertex& vertex : mesh.vertices) {
            vertex.nx = std::sin(degrees * std::numbers::pi_v<float> / 180);
            vertex.nz = -std::cos(degrees * std::numbers::pi_v<float> / 180);
        }
        return matte(renderPreview(mesh, {}, kStraight), 160, 240).sum();
    };
    for (const float degrees : {-30.f, -15.f, 0.f, 15.f}) {
        EXPECT_GT(brightness(degrees + 1), brightness(degrees) + 2) << degrees;
    }
}

TEST(Preview, FilledVerticesAreTintedInTheMatteHalfOnly) {
    const RgbImage measured =
        renderPreview(squareFacingTheScanner(100, 400, 0.1f), plainTexture(128), kStraight);
    const RgbImage filled =
        renderPreview(squareFacingTheScanner(100, 400, 0), plainTexture(128), kStraight);
    const Rgb before = matte(measured, 160, 240);
    const Rgb after = matte(filled, 160, 240);
    EXPECT_GT(after.b - after.r, before.b - before.r + 20);
    EXPECT_EQ(textured(measured, 160, 240), textured(filled, 160, 240));
}

TEST(Preview, OutlinesAreSmooth) {
    Mesh mesh = squareFacingTheScanner(100, 400);
    for (Vertex& vertex : mesh.vertices) {
        vertex.x += 0.3f * vertex.y;
    }
    const RgbImage image = renderPreview(mesh, plainTexture(255), kStraight);
    std::set<int> levels;
    for (int y = 150; y < 330; ++y) {
        for (int x = 0; x < 100; ++x) levels.insert(textured(image, x, y).sum() / 60);
    }
    EXPECT_GE(levels.size(), 4u);
}

TEST(Preview, AMeshOfMoreThan65536VerticesIsDrawnWhole) {
    const RgbImage image =
        renderPreview(squareFacingTheScanner(100, 400, 1, 300), plainTexture(255), kStraight);
    EXPECT_EQ(textured(image, 20, 100), textured(image, 160, 240));
    EXPECT_EQ(textured(image, 300, 380), textured(image, 160, 240));
}

TEST(Preview, ATextureLargerThanAnyGpuTakesIsMadeSmaller) {
    const Mesh mesh = squareFacingTheScanner(100, 400);
    const RgbImage image = renderPreview(mesh, quarters(0, 80, 160, 240, 70000, 70), kStraight);
    const RgbImage small = renderPreview(mesh, quarters(0, 80, 160, 240), kStraight);
    // The texture is two rows high now: it shows its own greys a quarter from top and bottom.
    for (const int x : {60, 130, 190, 260}) {
        for (const int y : {96 + 72, 383 - 72}) {
            EXPECT_NEAR(textured(image, x, y).sum(), textured(small, x, y).sum(), 9)
                << x << ' ' << y;
        }
    }
}

TEST(Preview, AMeshWithoutATextureIsPlainGrey) {
    const RgbImage image = renderPreview(squareFacingTheScanner(100, 400), {}, kStraight);
    EXPECT_EQ(textured(image, 60, 150), textured(image, 250, 350));
    EXPECT_GT(textured(image, 160, 240).sum(), background().pixels[0] * 3);
}

TEST(Preview, OneRendererServesManyMeshesAndForgetsThem) {
    PreviewRenderer renderer;
    const RgbImage first = renderer.render(sphereCap(80, 400), quarters(0, 80, 160, 240));
    renderer.render(squareFacingTheScanner(100, 400), plainTexture(255), kStraight);
    EXPECT_EQ(renderer.render({}, {}, kStraight).pixels, background().pixels);
    EXPECT_EQ(renderer.render(sphereCap(80, 400), quarters(0, 80, 160, 240)).pixels, first.pixels);
}

TEST(Preview, TheSameInputGivesTheSameBytesInAnyRendererOnAnyThread) {
    const Mesh mesh = sphereCap(80, 400);
    const GreyImage texture = quarters(0, 80, 160, 240);
    const RgbImage expected = renderPreview(mesh, texture);
    RgbImage here, there;
    std::thread one([&] { here = renderPreview(mesh, texture); });
    std::thread other([&] { there = renderPreview(mesh, texture); });
    one.join();
    other.join();
    EXPECT_EQ(here.pixels, expected.pixels);
    EXPECT_EQ(there.pixels, expected.pixels);
}

TEST(Preview, ARendererMayBeMadeUsedAndEndedOnDifferentThreads) {
    std::unique_ptr<PreviewRenderer> renderer;
    std::thread([&] { renderer = std::make_unique<PreviewRenderer>(); }).join();
    RgbImage image;
    std::thread([&] { image = renderer->render({}, {}, kStraight); }).join();
    std::thread([&] { renderer.reset(); }).join();
    EXPECT_EQ(image.pixels, background().pixels);
}

TEST(Preview, RejectsASizeThatIsNoPicture) {
    PreviewRenderer renderer;
    for (const auto& [width, height] : {std::pair(1, 100), std::pair(100, 0), std::pair(-640, -480),
                                        std::pair(2'000'000'000, 2'000'000'000)}) {
        try {
            renderer.render({}, {}, {.width = width, .height = height, .viewpoint = {}});
            FAIL() << width << ' ' << height;
        } catch (const RenderError& error) {
            EXPECT_THAT(error.what(), HasSubstr(std::to_string(width)));
        }
    }
    EXPECT_EQ(renderer.render({}, {}, kStraight).pixels, background().pixels);
}

}  // namespace
}  // namespace facescan
