#include "export/read_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "export/mesh_format.h"
#include "export/peer.h"
#include "export/sample_mesh.h"
#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

template <typename Number>
void put(std::string& bytes, Number value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
}

/// A right triangle, written out by hand as the format says, without normals.
struct HandmadePly {
    std::string format = "format binary_little_endian 1.0\n";
    std::string comment = "comment TextureFile texture.png\n";
    std::string vertex_element = "element vertex 3\n";
    std::string properties =
        "property float x\nproperty float y\nproperty float z\n"
        "property float s\nproperty float t\nproperty float quality\n";
    std::string face_element = "element face 1\n";
    std::string list = "property list uchar uint vertex_indices\n";
    float z = 400;
    float quality = 1;
    unsigned char corners = 3;
    std::uint32_t last_corner = 2;

    std::string header() const {
        return "ply\n" + format + comment + vertex_element + properties + face_element + list +
               "end_header\n";
    }

    std::string bytes() const {
        std::string out = header();
        for (const auto& [x, y] : {std::pair(0.f, 0.f), {0.f, 10.f}, {20.f, 0.f}}) {
            for (const float f : {x, y, z, x / 20, 1 - y / 10, quality}) put(out, f);
        }
        out += char(corners);
        for (const std::uint32_t corner : {0u, 1u, last_corner}) put(out, corner);
        return out;
    }
};

class ReadMesh : public testing::Test {
protected:
    ReadMesh() { putFile(folder_ / "texture.png", encodeByStb(texture_)); }

    TexturedMesh read(const std::string& ply) {
        putFile(folder_ / "mesh.ply", ply);
        return readMesh(folder_ / "mesh.ply");
    }

    /// The message with which a file is refused; empty where it is read.
    std::string refusal(const std::string& ply) {
        try {
            read(ply);
        } catch (const ReadError& error) {
            EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
            EXPECT_THAT(error.what(), HasSubstr((folder_ / "").string()));
            return error.what();
        }
        return {};
    }

    std::string refusal(const HandmadePly& ply) { return refusal(ply.bytes()); }

    ScratchFolder folder_;
    GreyImage texture_ = markedTexture({5, 6});
};

TEST_F(ReadMesh, ReadsTheVerticesTrianglesAndTextureOfTheFormat) {
    const TexturedMesh result = read(HandmadePly{}.bytes());
    ASSERT_EQ(result.mesh.vertices.size(), 3u);
    ASSERT_EQ(result.mesh.triangles.size(), 1u);
    EXPECT_EQ(result.mesh.triangles[0], (Triangle{0, 1, 2}));
    const Vertex& v = result.mesh.vertices[2];
    EXPECT_EQ(v.x, 20);
    EXPECT_EQ(v.y, 0);
    EXPECT_EQ(v.z, 400);
    EXPECT_EQ(v.s, 1);
    EXPECT_EQ(v.t, 1);
    EXPECT_EQ(v.quality, 1);
    EXPECT_EQ(result.texture.width, texture_.width);
    EXPECT_EQ(result.texture.pixels, texture_.pixels);
}

TEST_F(ReadMesh, WorksOutNormalsThatAreNotThere) {
    for (const Vertex& v : read(HandmadePly{}.bytes()).mesh.vertices) {
        EXPECT_EQ(v.nx, 0);
        EXPECT_EQ(v.ny, 0);
        EXPECT_EQ(v.nz, -1);
    }
}

TEST_F(ReadMesh, FindsThePropertiesInAnyOrderAmongOthers) {
    std::string ply =
        "ply\r\nformat binary_little_endian 1.0\r\nobj_info by another program\r\n"
        "comment TextureFile texture.png\r\nelement vertex 3\r\n"
        "property uchar red\r\nproperty float quality\r\nproperty float t\r\nproperty float s\r\n"
        "property double confidence\r\nproperty float nz\r\nproperty float ny\r\n"
        "property float nx\r\nproperty float z\r\nproperty float32 y\r\nproperty float x\r\n"
        "element face 1\r\nproperty list uint8 uint32 vertex_indices\r\nend_header\r\n";
    for (int k = 0; k < 3; ++k) {
        ply += char(200);
        for (const float f : {0.5f, 0.25f, 0.75f}) put(ply, f);
        put(ply, 1e300);
        for (const float f : {-1.f, 0.f, 0.f, 400.f, 2.f, float(k)}) put(ply, f);
    }
    ply += char(3);
    for (const std::uint32_t corner : {2u, 1u, 0u}) put(ply, corner);

    const Mesh mesh = read(ply).mesh;
    ASSERT_EQ(mesh.vertices.size(), 3u);
    const Vertex& v = mesh.vertices[2];
    EXPECT_EQ(std::tie(v.x, v.y, v.z), std::tuple(2.f, 2.f, 400.f));
    EXPECT_EQ(std::tie(v.nx, v.ny, v.nz), std::tuple(0.f, 0.f, -1.f));
    EXPECT_EQ(std::tie(v.s, v.t, v.quality), std::tuple(0.75f, 0.25f, 0.5f));
    EXPECT_EQ(mesh.triangles[0], (Triangle{2, 1, 0}));
}

TEST_F(ReadMesh, ReadsBackWhatWriteMeshWrote) {
    const Mesh mesh = sampleMesh();
    writeMesh(folder_ / "mesh.ply", mesh, texture_, MeshFormat::ply);
    const TexturedMesh result = readMesh(folder_ / "mesh.ply");
    ASSERT_EQ(result.mesh.vertices.size(), mesh.vertices.size());
    EXPECT_EQ(std::memcmp(result.mesh.vertices.data(), mesh.vertices.data(),
                          mesh.vertices.size() * sizeof(Vertex)),
              0);
    EXPECT_EQ(result.mesh.triangles, mesh.triangles);
    EXPECT_EQ(result.texture.pixels, texture_.pixels);
}

TEST_F(ReadMesh, RejectsAFileCutShortAnywhere) {
    const std::string whole = HandmadePly{}.bytes();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_NE(refusal(whole.substr(0, size)), "") << size;
    }
    EXPECT_THAT(refusal(whole + "x"), EndsWith("1 bytes after the last triangle"));
}

TEST_F(ReadMesh, TakesNoMemoryOnTheWordOfACount) {
    for (const char* count : {"4", "4000000000", "18446744073709551615"}) {
        HandmadePly vertices;
        vertices.vertex_element = std::string("element vertex ") + count + "\n";
        EXPECT_THAT(refusal(vertices), HasSubstr("too short for the ")) << count;
        HandmadePly faces;
        faces.face_element = std::string("element face ") + count + "\n";
        EXPECT_THAT(refusal(faces), HasSubstr("too short for the ")) << count;
    }
}

TEST_F(ReadMesh, RejectsACountThatIsNoNumber) {
    for (const char* count : {"-1", "3.0", "18446744073709551616", "three"}) {
        HandmadePly ply;
        ply.vertex_element = std::string("element vertex ") + count + "\n";
        EXPECT_THAT(refusal(ply), HasSubstr(std::string("a count is '") + count + "'"));
    }
}

TEST_F(ReadMesh, SaysThatOnlyPlyByTheFormatIsRead) {
    EXPECT_THAT(refusal("solid face\n"), EndsWith("only PLY meshes by facescan's format are read"));
    EXPECT_THAT(refusal(""), EndsWith("only PLY meshes by facescan's format are read"));
}

TEST_F(ReadMesh, RejectsWhatTheFormatDoesNotKnow) {
    HandmadePly ply;
    ply.format = "format ascii 1.0\n";
    EXPECT_THAT(refusal(ply), HasSubstr("the format is 'ascii 1.0'"));
    ply = {};
    ply.properties += "property float x\n";
    EXPECT_THAT(refusal(ply), HasSubstr("'x' stands twice"));
    ply = {};
    ply.properties = "property float x\nproperty float y\nproperty double z\n";
    EXPECT_THAT(refusal(ply), HasSubstr("'z' is not float"));
    ply = {};
    ply.properties = "property float x\nproperty float y\nproperty float z\n";
    EXPECT_THAT(refusal(ply), HasSubstr("no property 's'"));
    ply = {};
    ply.properties += "property list uchar int neighbours\n";
    EXPECT_THAT(refusal(ply), HasSubstr("a list other than"));
    ply = {};
    ply.properties += "property quaternion pose\n";
    EXPECT_THAT(refusal(ply), HasSubstr("has the type 'quaternion'"));
    ply = {};
    ply.list = "property list int uint vertex_indices\n";
    EXPECT_THAT(refusal(ply), HasSubstr("a list other than"));
    ply = {};
    ply.list += "element edge 0\n";
    EXPECT_THAT(refusal(ply), HasSubstr("the element 'edge'"));
    ply = {};
    ply.face_element = ply.list = "";
    EXPECT_THAT(refusal(ply), HasSubstr("no faces"));
    ply = {};
    ply.comment = "surprise\n";
    EXPECT_THAT(refusal(ply), HasSubstr("the line 'surprise'"));
}

TEST_F(ReadMesh, RejectsNumbersThatNoMeshHas) {
    HandmadePly ply;
    ply.z = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(ply), HasSubstr("vertex 0 has a number that is not finite"));
    ply.z = std::numeric_limits<float>::infinity();
    EXPECT_THAT(refusal(ply), HasSubstr("not finite"));
    ply = {};
    ply.quality = 1.5f;
    EXPECT_THAT(refusal(ply), HasSubstr("0 to 1 expected"));
    ply = {};
    ply.corners = 4;
    EXPECT_THAT(refusal(ply), HasSubstr("face 0 has 4 corners; triangles expected"));
    ply = {};
    ply.last_corner = 3;
    EXPECT_THAT(refusal(ply), HasSubstr("triangle 0 names vertex 3 of 3"));
}

TEST_F(ReadMesh, NeverLeavesTheFolderForTheTexture) {
    for (const char* name :
         {"../texture.png", "/etc/passwd", "..", "a b.png", "sub\\texture.png"}) {
        HandmadePly ply;
        ply.comment = std::string("comment TextureFile ") + name + "\n";
        EXPECT_THAT(refusal(ply), HasSubstr("TextureFile is not the plain name")) << name;
    }
}

TEST_F(ReadMesh, NamesTheTextureThatIsMissingOrBroken) {
    putFile(folder_ / "texture.png", "no picture");
    EXPECT_THAT(refusal(HandmadePly{}), HasSubstr("texture.png: "));
    std::filesystem::remove(folder_ / "texture.png");
    EXPECT_THAT(refusal(HandmadePly{}), HasSubstr("texture.png: no such file"));
}

TEST_F(ReadMesh, DoesNotWaitForAPipe) {
    ASSERT_EQ(::mkfifo((folder_ / "pipe.ply").c_str(), 0600), 0);
    EXPECT_THROW(readMesh(folder_ / "pipe.ply"), ReadError);
    EXPECT_THROW(readMesh(folder_ / "missing.ply"), ReadError);
}

TEST_F(ReadMesh, ShowsNoControlCharactersOfAHostileFile) {
    HandmadePly ply;
    ply.comment = "\x1b[2Jline\n";
    EXPECT_THAT(refusal(ply), HasSubstr("the line '?[2Jline'"));
}

TEST_F(ReadMesh, ReturnsASoundMeshOrAnErrorForAnyDamage) {
    const std::string whole = HandmadePly{}.bytes();
    std::uint32_t state = 7;
    const auto random = [&](std::size_t below) {
        state = state * 1664525u + 1013904223u;
        return (state >> 8) % below;
    };
    for (int round = 0; round < 1000; ++round) {
        std::string damaged = whole;
        for (std::size_t k = 0; k <= random(3); ++k)
            damaged[random(whole.size())] = char(random(256));
        try {
            const Mesh mesh = read(damaged).mesh;
            for (const Triangle& t : mesh.triangles) {
                for (const std::uint32_t corner : t) EXPECT_LT(corner, mesh.vertices.size());
            }
            for (const Vertex& v : mesh.vertices) EXPECT_TRUE(std::isfinite(v.x + v.y + v.z));
        } catch (const ReadError&) {
        }
    }
}

}  // namespace
}  // namespace facescan::test
