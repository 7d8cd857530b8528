#include "export/stl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/peer.h"
#include "export/sample_mesh.h"
#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

using testing::HasSubstr;

std::string stlOf(const Mesh& mesh) {
    std::string bytes;
    formatStl(mesh, bytes);
    return bytes;
}

TEST(Stl, IsTheSameSurfaceInMillimetresForAssimp) {
    const ScratchFolder folder;
    putFile(folder / "mesh.stl", stlOf(sampleMesh()));
    const std::vector<Facet> peer = readByAssimp(folder / "mesh.stl").facets;
    const std::vector<Facet> expected = facetsOf(sampleMesh());
    ASSERT_EQ(peer.size(), expected.size());
    for (std::size_t f = 0; f < expected.size(); ++f) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(peer[f][k].position, expected[f][k].position);
    }
}

TEST(Stl, GivesEachFacetTheUnitNormalOfItsWindingTowardsTheCamera) {
    const ScratchFolder folder;
    putFile(folder / "mesh.stl", stlOf(sampleMesh()));
    for (const Facet& facet : readByAssimp(folder / "mesh.stl").facets) {
        const std::array<float, 3> winding = windingNormal(facet);
        EXPECT_NEAR(dot(facet[0].normal, facet[0].normal), 1, 1e-5);
        EXPECT_NEAR(dot(facet[0].normal, winding), std::sqrt(dot(winding, winding)), 1e-5);
        EXPECT_LT(facet[0].normal[2], 0);
    }
}

TEST(Stl, StatesItsUnitsAndIsNotTakenForText) {
    const std::string bytes = stlOf(sampleMesh());
    EXPECT_THAT(bytes.substr(0, 80), HasSubstr("units: mm"));
    EXPECT_NE(bytes.substr(0, 5), "solid");
    EXPECT_EQ(bytes.size(), 84 + 50 * sampleMesh().triangles.size());
}

TEST(Stl, GivesATriangleWithoutAreaNoNormalRatherThanNan) {
    Mesh mesh = sampleMesh();
    mesh.triangles = {{0, 0, 1}};
    EXPECT_EQ(stlOf(mesh).substr(84, 12), std::string(12, '\0'));
}

}  // namespace
}  // namespace facescan::test
