#include "export/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include "export/peer.h"
#include "export/sample_mesh.h"
#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

using testing::HasSubstr;

std::string plyOf(const Mesh& mesh) {
    std::string bytes;
    formatPly(mesh, bytes);
    return bytes;
}

struct CommandResult {
    int status;
    std::string output;
};

CommandResult runCommand(const std::string& command) {
    FILE* pipe = ::popen(command.c_str(), "r");
    CommandResult result{};
    std::array<char, 4096> block;
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
        result.output.append(block.data(), count);
    }
    result.status = ::pclose(pipe);
    return result;
}

/// What ply_peer.py prints for a mesh that holds exactly this.
std::string asText(const Mesh& mesh) {
    std::ostringstream text;
    text << std::setprecision(9);  // enough to tell any two floats apart
    text << "float x, float y, float z, float nx, float ny, float nz, float s, float t, "
            "float quality\n";
    for (const Vertex& v : mesh.vertices) {
        const char* separator = "";
        for (const float f : {v.x, v.y, v.z, v.nx, v.ny, v.nz, v.s, v.t, v.quality}) {
            text << separator << f;
            separator = " ";
        }
        text << "\n";
    }
    for (const Triangle& t : mesh.triangles) text << t[0] << " " << t[1] << " " << t[2] << "\n";
    return text.str();
}

TEST(Ply, HoldsEveryPropertyOfTheFormatForAReaderInPython) {
    const ScratchFolder folder;
    putFile(folder / "mesh.ply", plyOf(sampleMesh()));
    const CommandResult peer =
        runCommand(PYTHON " " PLY_PEER " '" + (folder / "mesh.ply").string() + "' 2>&1");
    ASSERT_EQ(peer.status, 0) << peer.output;
    EXPECT_THAT(peer.output, HasSubstr("comment TextureFile texture.png\n"));
    EXPECT_THAT(peer.output, HasSubstr("comment units: mm\n"));
    EXPECT_THAT(peer.output, HasSubstr("comment axes: X right, Y down, Z away from the camera"));
    EXPECT_THAT(peer.output, testing::EndsWith(asText(sampleMesh())));
}

TEST(Ply, IsTheSameMeshForAssimp) {
    const ScratchFolder folder;
    putFile(folder / "mesh.ply", plyOf(sampleMesh()));
    const PeerMesh peer = readByAssimp(folder / "mesh.ply");
    const std::vector<Facet> expected = facetsOf(sampleMesh());
    ASSERT_EQ(peer.facets.size(), expected.size());
    EXPECT_EQ(peer.texture_file, "texture.png");
    for (std::size_t f = 0; f < expected.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(peer.facets[f][k].position, expected[f][k].position);
            EXPECT_EQ(peer.facets[f][k].normal, expected[f][k].normal);
            EXPECT_EQ(peer.facets[f][k].texture, expected[f][k].texture);
        }
    }
}

TEST(Ply, FacesTheCamera) {
    const ScratchFolder folder;
    putFile(folder / "mesh.ply", plyOf(sampleMesh()));
    for (const Facet& facet : readByAssimp(folder / "mesh.ply").facets) {
        EXPECT_LT(dot(windingNormal(facet), facet[0].position), 0);  // the camera is at the origin
        EXPECT_GT(dot(windingNormal(facet), facet[0].normal), 0);
    }
}

TEST(Ply, OfAnEmptyMeshHasNoVerticesAndNoFaces) {
    const std::string bytes = plyOf(Mesh{});
    EXPECT_THAT(bytes, HasSubstr("element vertex 0\n"));
    EXPECT_THAT(bytes, HasSubstr("element face 0\n"));
    EXPECT_THAT(bytes, testing::EndsWith("end_header\n"));
}

TEST(Ply, OverwritesWhatTheBufferHeld) {
    std::string reused(1'000'000, 'x');
    formatPly(sampleMesh(), reused);
    EXPECT_EQ(reused, plyOf(sampleMesh()));
}

}  // namespace
}  // namespace facescan::test
