#include "export/mesh_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/peer.h"
#include "export/sample_mesh.h"
#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MeshFormat, IsKnownByItsNameInAnyCase) {
    EXPECT_EQ(parseMeshFormat("ply"), MeshFormat::ply);
    EXPECT_EQ(parseMeshFormat("OBJ"), MeshFormat::obj);
    EXPECT_EQ(parseMeshFormat("Stl"), MeshFormat::stl);
    EXPECT_EQ(parseMeshFormat("glb"), MeshFormat::glb);
    EXPECT_EQ(parseMeshFormat("gltf"), std::nullopt);
    EXPECT_EQ(parseMeshFormat(""), std::nullopt);
    EXPECT_STREQ(name(MeshFormat::glb), "glb");
}

TEST(MeshFormat, IsKnownByAFilesExtension) {
    EXPECT_EQ(meshFormatOf("out/face.stl"), MeshFormat::stl);
    EXPECT_EQ(meshFormatOf("face.v2.GLB"), MeshFormat::glb);
    EXPECT_EQ(meshFormatOf("face"), std::nullopt);
    EXPECT_EQ(meshFormatOf("ply"), std::nullopt);
    EXPECT_EQ(meshFormatOf("face."), std::nullopt);
}

TEST(WriteMesh, PutsWhatBelongsToAMeshBesideIt) {
    const auto namesOf = [](const char* file, MeshFormat format) {
        const ScratchFolder folder;
        writeMesh(folder / file, sampleMesh(), markedTexture({1, 1}), format);
        return folder.names();
    };
    EXPECT_THAT(namesOf("mesh.ply", MeshFormat::ply), ElementsAre("mesh.ply", "texture.png"));
    EXPECT_THAT(namesOf("a.obj", MeshFormat::obj), ElementsAre("a.mtl", "a.obj", "a.png"));
    EXPECT_THAT(namesOf("mesh.stl", MeshFormat::stl), ElementsAre("mesh.stl"));
    EXPECT_THAT(namesOf("mesh.glb", MeshFormat::glb), ElementsAre("mesh.glb"));
}

TEST(WriteMesh, ShowsTheMarkedPixelAtTheVertexThatLiesOnItInPly) {
    const ScratchFolder folder;
    const std::size_t marked = 30;
    writeMesh(folder / "mesh.ply", sampleMesh(), markedTexture(samplePixel(marked)),
              MeshFormat::ply);
    const PeerMesh peer = readByAssimp(folder / "mesh.ply");
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

TEST(WriteMesh, LeavesFormerFilesWholeWhereTheDiskIsFull) {
    for (const MeshFormat format :
         {MeshFormat::ply, MeshFormat::obj, MeshFormat::stl, MeshFormat::glb}) {
        const ScratchFolder folder;
        const std::string file = std::string("mesh.") + name(format);
        putFile(folder / file, "former mesh");
        putFile(folder / "texture.png", "former texture");
        std::string message;
        try {
            const FileSizeLimit limit(1000);
            writeMesh(folder / file, sampleMesh(), markedTexture({1, 1}), format);
        } catch (const WriteError& error) {
            message = error.what();
        }
        EXPECT_THAT(message, HasSubstr(file + ": File too large"));
        EXPECT_EQ(contentOf(folder / file), "former mesh");
        EXPECT_EQ(contentOf(folder / "texture.png"), "former texture");
        EXPECT_THAT(folder.names(), ElementsAre(file, "texture.png"));
    }
}

TEST(WriteMesh, NamesTheFileWhereTheTextureIsEmpty) {
    const ScratchFolder folder;
    try {
        writeMesh(folder / "mesh.ply", sampleMesh(), GreyImage{}, MeshFormat::ply);
        ADD_FAILURE() << "nothing thrown";
    } catch (const WriteError& error) {
        EXPECT_THAT(error.what(), HasSubstr("mesh.ply: PNG: the image is empty"));
    }
    EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace facescan::test
