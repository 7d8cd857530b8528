#include "thesis/fill_holes.h"

#include <gmock/gmock.h>

#include "thesis/small_surface.h"

namespace facescan::thesis {
namespace {

TEST(ThesisFillHoles, ASurfaceWithoutHolesHasOneBoundary) {
    const auto loops = boundaryLoops(flatGrid(4, 3).faces);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0].size(), 10u);
}

TEST(ThesisFillHoles, LeavesASurfaceWithoutHolesAsItIs) {
    Surface surface = flatGrid(4, 3);
    fillHoles(surface);
    EXPECT_EQ(surface.vertices.size(), 12u);
    EXPECT_EQ(surface.faces.size(), 12u);
}

TEST(ThesisFillHoles, AFanClosesAHole) {
    const Surface whole = flatGrid(5, 5);
    Surface surface = without(12, whole);
    ASSERT_EQ(boundaryLoops(surface.faces).size(), 2u);
    fillHoles(surface);
    EXPECT_EQ(boundaryLoops(surface.faces).size(), 1u);
    EXPECT_DOUBLE_EQ(imageArea(surface), imageArea(whole));
}

TEST(ThesisFillHoles, TheFilledVertexLiesInTheMiddleOfTheRim) {
    Surface surface = without(12, flatGrid(5, 5));
    fillHoles(surface);
    const SurfaceVertex& filled = surface.vertices.back();
    EXPECT_EQ(filled.line, -1);
    EXPECT_NEAR(filled.image.x, 2, 1e-12);
    EXPECT_NEAR(filled.image.y, 2, 1e-12);
    EXPECT_NEAR(filled.place.z, 400, 1e-9);
}

TEST(ThesisFillHoles, TheNotchOfAnOutlineIsNoHole) {
    Surface surface = without(2, flatGrid(5, 5));
    const std::size_t faces = surface.faces.size();
    fillHoles(surface);
    EXPECT_EQ(surface.faces.size(), faces);
}

TEST(ThesisFillHoles, HolesThatTouchInOneVertexAreClosedEachByItself) {
    // The vertices (2, 2) and (4, 4) of a 7 × 7 grid are gone; their rims share the vertex (3, 3).
    const Surface whole = flatGrid(7, 7);
    Surface surface = without(16, without(32, whole));
    fillHoles(surface);
    EXPECT_EQ(surface.vertices.size(), 49u);
    EXPECT_DOUBLE_EQ(imageArea(surface), imageArea(whole));
}

}  // namespace
}  // namespace facescan::thesis
