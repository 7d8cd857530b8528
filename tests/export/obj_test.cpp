#include "export/obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/mesh_format.h"
#include "export/peer.h"
#include "export/sample_mesh.h"
#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

using testing::HasSubstr;

// Assimp's own way from text to floats rounds the last digit.
constexpr float kDigit = 5e-5f;  // mm, of values up to 400

TEST(Obj, IsTheSameSurfaceInMillimetresForAssimp) {
    const ScratchFolder folder;
    writeMesh(folder / "mesh.obj", sampleMesh(), markedTexture({0, 0}), MeshFormat::obj);
    const PeerMesh peer = readByAssimp(folder / "mesh.obj");
    const std::vector<Facet> expected = facetsOf(sampleMesh());
    ASSERT_EQ(peer.facets.size(), expected.size());
    ASSERT_TRUE(peer.has_normals);
    for (std::size_t f = 0; f < expected.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(peer.facets[f][k].position[axis], expected[f][k].position[axis],
                            kDigit);
                EXPECT_NEAR(peer.facets[f][k].normal[axis], expected[f][k].normal[axis], 1e-6);
            }
        }
        EXPECT_GT(dot(windingNormal(peer.facets[f]), peer.facets[f][0].normal), 0);
    }
}

TEST(Obj, ShowsTheMarkedPixelAtTheVertexThatLiesOnIt) {
    const ScratchFolder folder;
    const std::size_t marked = 17;
    writeMesh(folder / "mesh.obj", sampleMesh(), markedTexture(samplePixel(marked)),
              MeshFormat::obj);
    const PeerMesh peer = readByAssimp(folder / "mesh.obj");
    ASSERT_EQ(peer.texture_file, "mesh.png");
    const GreyImage texture = decodeByStb(contentOf(folder / peer.texture_file));
    const Mesh mesh = sampleMesh();
    ASSERT_EQ(peer.facets.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const bool on_mark = mesh.triangles[f][k] == marked;
            EXPECT_EQ(sampleNearest(texture, peer.facets[f][k].texture), on_mark ? 255 : 0);
        }
    }
}

TEST(Obj, StatesUnitsAndAxes) {
    std::string text;
    formatObj(sampleMesh(), "mesh.mtl", text);
    EXPECT_THAT(text, HasSubstr("# units: mm\n"));
    EXPECT_THAT(text, HasSubstr("# axes: X right, Y down, Z away from the camera"));
}

TEST(Obj, WritesTheShortestDigitsThatGiveTheSameFloat) {
    Mesh mesh;
    mesh.vertices = {{0.1f, -1.5e-7f, 411.90002f, 0, 0, -1, 0.5f, 1, 1}};
    std::string text;
    formatObj(mesh, "mesh.mtl", text);
    EXPECT_THAT(text, HasSubstr("\nv 0.1 -1.5e-07 411.90002\n"));
    EXPECT_THAT(text, HasSubstr("\nvt 0.5 1\n"));
    EXPECT_THAT(text, HasSubstr("\nvn 0 0 -1\n"));
}

TEST(Obj, OfANameWithWhiteSpaceStillFindsItsTexture) {
    const ScratchFolder folder;
    writeMesh(folder / "Ann Smith #2.obj", sampleMesh(), markedTexture({2, 2}), MeshFormat::obj);
    const PeerMesh peer = readByAssimp(folder / "Ann Smith #2.obj");
    EXPECT_EQ(peer.texture_file, "Ann_Smith__2.png");
    EXPECT_THAT(folder.names(), testing::Contains("Ann_Smith__2.png"));
}

TEST(ObjFileStem, ChangesOnlyWhatTheTextCannotCarry) {
    EXPECT_EQ(objFileStem("mesh-1.v2"), "mesh-1.v2");
    EXPECT_EQ(objFileStem("Müller"), "Müller");
    EXPECT_EQ(objFileStem("-s\n#\"\\"), "_s____");
}

}  // namespace
}  // namespace facescan::test
