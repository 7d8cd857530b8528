#include "thesis/to_mesh.h"

#include <gtest/gtest.h>

#include "thesis/small_surface.h"

namespace facescan::thesis {
namespace {

TEST(ThesisToMesh, APlaneBeforeTheCameraFacesIt) {
    for (const Vertex& vertex : toMesh(flatGrid(4, 4), {0, 0, 4, 4}).vertices) {
        EXPECT_FLOAT_EQ(vertex.nx, 0);
        EXPECT_FLOAT_EQ(vertex.ny, 0);
        EXPECT_FLOAT_EQ(vertex.nz, -1);
    }
}

TEST(ThesisToMesh, TextureCoordinatesFollowTheFormat) {
    Surface surface = flatGrid(2, 2);
    surface.vertices[0].image = {14, 30};
    const Mesh mesh = toMesh(surface, {10, 20, 16, 40});
    EXPECT_FLOAT_EQ(mesh.vertices[0].s, 4.5f / 16);
    EXPECT_FLOAT_EQ(mesh.vertices[0].t, 1 - 10.5f / 40);
}

TEST(ThesisToMesh, FilledVerticesAreMarked) {
    Surface surface = flatGrid(2, 2);
    surface.vertices[3].line = -1;
    const Mesh mesh = toMesh(surface, {0, 0, 2, 2});
    EXPECT_EQ(mesh.vertices[0].quality, 1);
    EXPECT_EQ(mesh.vertices[3].quality, 0);
}

}  // namespace
}  // namespace facescan::thesis
