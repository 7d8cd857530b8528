#include "thesis/filter.h"

#include <gmock/gmock.h>

#include "thesis/small_surface.h"

namespace facescan::thesis {
namespace {

TEST(ThesisFilter, KeepsAPlaneWhole) {
    Surface surface = flatGrid(6, 6);
    dropLonely({2, 1}, surface);
    dropOutOfRange(300, 520, surface);
    dropLongFaces(7, surface);
    EXPECT_EQ(surface.vertices.size(), 36u);
    EXPECT_EQ(surface.faces.size(), 50u);
}

TEST(ThesisFilter, AVertexFarInFrontOfItsNeighboursGoesWithItsFaces) {
    Surface surface = flatGrid(5, 5);
    surface.vertices[12].place.z -= 30;
    dropLonely({2, 1}, surface);
    EXPECT_EQ(surface.vertices.size(), 24u);
    EXPECT_EQ(surface.faces.size(), 32u - 6u);
}

TEST(ThesisFilter, AVertexFarFromItsNeighboursOnTheLineGoes) {
    Surface surface;
    for (const double y : {1.0, 2.0, 20.0, 40.0, 41.0}) {
        surface.vertices.push_back({{0, y}, {0, y, 400}, 0});
    }
    dropLonely({5, 1}, surface);
    ASSERT_EQ(surface.vertices.size(), 4u);
    EXPECT_EQ(surface.vertices[2].image.y, 40);
}

TEST(ThesisFilter, BothSidesOfAStepStay) {
    Surface surface;
    for (int y = 0; y < 6; ++y) {
        surface.vertices.push_back({{0, double(y)}, {0, 0, y < 3 ? 400.0 : 380.0}, 0});
    }
    dropLonely({2, 1}, surface);
    EXPECT_EQ(surface.vertices.size(), 6u);
}

TEST(ThesisFilter, NeighboursOnOtherLinesDoNotCount) {
    Surface surface;
    surface.vertices = {{{0, 5}, {0, 0, 400}, 0}, {{1, 5}, {0, 0, 400}, 1}};
    dropLonely({5, 5}, surface);
    EXPECT_TRUE(surface.vertices.empty());
}

TEST(ThesisFilter, AMarginAtTheImageBorderIsCutOff) {
    Surface surface = flatGrid(10, 8);
    dropBorder({0, 0, 10, 8}, 2, surface);
    EXPECT_EQ(surface.vertices.size(), 6u * 4u);
}

TEST(ThesisFilter, OnlyTheMeasurementRangeIsKept) {
    Surface surface = flatGrid(2, 2);
    surface.vertices[0].place.z = 299;
    surface.vertices[1].place.z = 521;
    dropOutOfRange(300, 520, surface);
    EXPECT_EQ(surface.vertices.size(), 2u);
}

TEST(ThesisFilter, AFaceAcrossAGapGoes) {
    Surface surface = flatGrid(10, 10);
    // Two vertices at the border move away: one by less than 7 mean edges of √2 mm, one by more.
    surface.vertices[9].place.z += 8;
    surface.vertices[99].place.z += 20;
    dropLongFaces(7, surface);
    EXPECT_EQ(surface.faces.size(), 162u - 2u);
}

}  // namespace
}  // namespace facescan::thesis
