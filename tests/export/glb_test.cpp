#include "export/glb.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "export/mesh_format.h"
#include "export/peer.h"
#include "export/sample_mesh.h"
#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

constexpr float kMillimetre = 1e-3f;  // in metres

std::uint32_t u32At(const std::string& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

/// The JSON chunk of a GLB file, by the layout in the glTF 2.0 specification, section 4.
nlohmann::json jsonOf(const std::string& glb) {
    return nlohmann::json::parse(glb.substr(20, u32At(glb, 12)));
}

std::string glbOf(const Mesh& mesh) {
    std::string bytes;
    formatGlb(mesh, encodeByStb(markedTexture({0, 0})), bytes);
    return bytes;
}

PeerMesh peerOf(const std::string& glb) {
    const ScratchFolder folder;
    putFile(folder / "mesh.glb", glb);
    return readByAssimp(folder / "mesh.glb");
}

TEST(Glb, IsTheSameSurfaceInMetresWithYUpForAssimp) {
    const PeerMesh peer = peerOf(glbOf(sampleMesh()));
    const std::vector<Facet> expected = facetsOf(sampleMesh());
    ASSERT_EQ(peer.facets.size(), expected.size());
    ASSERT_TRUE(peer.has_normals);
    for (std::size_t f = 0; f < expected.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Corner& is = peer.facets[f][k];
            const Corner& was = expected[f][k];
            EXPECT_FLOAT_EQ(is.position[0], was.position[0] * kMillimetre);
            EXPECT_FLOAT_EQ(is.position[1], -was.position[1] * kMillimetre);
            EXPECT_FLOAT_EQ(is.position[2], -was.position[2] * kMillimetre);
            EXPECT_FLOAT_EQ(is.normal[0], was.normal[0]);
            EXPECT_FLOAT_EQ(is.normal[1], -was.normal[1]);
            EXPECT_FLOAT_EQ(is.normal[2], -was.normal[2]);
        }
    }
}

TEST(Glb, LooksAtTheViewer) {
    for (const Facet& facet : peerOf(glbOf(sampleMesh())).facets) {
        EXPECT_GT(facet[0].normal[2], 0);
        EXPECT_GT(dot(windingNormal(facet), facet[0].normal), 0);
    }
}

TEST(Glb, ShowsTheMarkedPixelAtTheVertexThatLiesOnIt) {
    const ScratchFolder folder;
    const std::size_t marked = 40;
    writeMesh(folder / "mesh.glb", sampleMesh(), markedTexture(samplePixel(marked)),
              MeshFormat::glb);
    const PeerMesh peer = readByAssimp(folder / "mesh.glb");
    const GreyImage texture = decodeByStb(peer.texture_bytes);
    const Mesh mesh = sampleMesh();
    ASSERT_EQ(peer.facets.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const bool on_mark = mesh.triangles[f][k] == marked;
            EXPECT_EQ(sampleNearest(texture, peer.facets[f][k].texture), on_mark ? 255 : 0);
        }
    }
}

TEST(Glb, StoresTextureCoordinatesFromTheTopLeft) {
    const std::string glb = glbOf(sampleMesh());
    const nlohmann::json json = jsonOf(glb);
    const auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    const auto& accessor = json["accessors"][attributes["TEXCOORD_0"].get<int>()];
    const auto& buffer_view = json["bufferViews"][accessor["bufferView"].get<int>()];
    const std::size_t binary_chunk = 20 + u32At(glb, 12) + 8;
    const std::size_t first =
        binary_chunk + buffer_view.value("byteOffset", 0) + accessor.value("byteOffset", 0);
    std::array<float, 2> uv;
    std::memcpy(uv.data(), glb.data() + first, sizeof(uv));
    // The first vertex lies on pixel (2, 2) of 48 × 36.
    EXPECT_FLOAT_EQ(uv[0], 2.5f / 48);
    EXPECT_FLOAT_EQ(uv[1], 2.5f / 36);
}

TEST(Glb, IsLaidOutAsTheSpecificationAsks) {
    const std::string glb = glbOf(sampleMesh());
    EXPECT_EQ(glb.substr(0, 4), "glTF");
    EXPECT_EQ(u32At(glb, 4), 2u);
    EXPECT_EQ(u32At(glb, 8), glb.size());
    EXPECT_EQ(glb.substr(16, 4), "JSON");
    EXPECT_EQ(u32At(glb, 12) % 4, 0u);
    const std::size_t binary = 20 + u32At(glb, 12);
    EXPECT_EQ(glb.substr(binary + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(binary + 8 + u32At(glb, binary), glb.size());

    const nlohmann::json json = jsonOf(glb);
    EXPECT_EQ(json["asset"]["version"], "2.0");
    EXPECT_EQ(json["images"][0]["mimeType"], "image/png");
    EXPECT_FALSE(json["images"][0].contains("uri"));
    for (const auto& accessor : json["accessors"]) {
        const auto& view = json["bufferViews"][accessor["bufferView"].get<int>()];
        EXPECT_EQ((view.value("byteOffset", 0) + accessor.value("byteOffset", 0)) % 4, 0);
    }
}

TEST(Glb, StatesTheBoundsOfThePositionsThatItStores) {
    const nlohmann::json json = jsonOf(glbOf(sampleMesh()));
    const int index = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    // x from pixel 2 to 46 of 48, y from 2 to 34 of 36 turned over, at 0.4 mm a pixel.
    EXPECT_FLOAT_EQ(json["accessors"][index]["min"][0], -22 * 0.4f * kMillimetre);
    EXPECT_FLOAT_EQ(json["accessors"][index]["max"][0], 22 * 0.4f * kMillimetre);
    EXPECT_FLOAT_EQ(json["accessors"][index]["min"][1], -16 * 0.4f * kMillimetre);
    EXPECT_FLOAT_EQ(json["accessors"][index]["max"][1], 16 * 0.4f * kMillimetre);
}

TEST(Glb, OfAnEmptyMeshIsASceneWithoutMeshes) {
    const nlohmann::json json = jsonOf(glbOf(Mesh{}));
    EXPECT_FALSE(json.contains("meshes"));
    EXPECT_FALSE(json.contains("accessors"));
    EXPECT_EQ(json["scenes"].size(), 1u);
}

TEST(Glb, HasTheSameBytesEveryTime) {
    EXPECT_EQ(glbOf(sampleMesh()), glbOf(sampleMesh()));
}

}  // namespace
}  // namespace facescan::test
