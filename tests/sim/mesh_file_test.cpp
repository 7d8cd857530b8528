#include "sim/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace facescan::sim {
namespace {

class MeshFile : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        const std::filesystem::path path = testing::TempDir() + name;
        std::ofstream(path) << text;
        return path;
    }
};

/// A square of 2 × 4 that looks along +Z.
const char kObj[] =
    "v -1 -2 5\nv 1 -2 5\nv 1 2 5\nv -1 2 5\n"
    "f 1 2 3 4\n";

TEST_F(MeshFile, ReadsAnObjInItsOwnFrame) {
    const Scene scene = loadMesh(write("own.obj", kObj), {.in_scanner_frame = true});
    EXPECT_EQ(scene.kind, "mesh");
    ASSERT_EQ(scene.surface.positions.size(), 4u);
    EXPECT_EQ(scene.surface.triangles.size(), 2u) << "the quad is divided";
    for (const Eigen::Vector3f& p : scene.surface.positions) EXPECT_EQ(p.z(), 5);
    EXPECT_EQ(scene.surface.materials[0].albedo, 0.5f);
}

TEST_F(MeshFile, PlacesAMeshUprightBeforeTheScanner) {
    const Scene scene = loadMesh(write("placed.obj", kObj),
                                 {.height_mm = 200, .nearest_mm = 390, .offset_y_mm = 7});
    Eigen::Vector3f low(1e9f, 1e9f, 1e9f), high = -low;
    for (const Eigen::Vector3f& p : scene.surface.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    EXPECT_LT((low - Eigen::Vector3f(-50, -93, 390)).norm(), 1e-3f);
    EXPECT_LT((high - Eigen::Vector3f(50, 107, 390)).norm(), 1e-3f);
    for (const Eigen::Vector3f& n : scene.surface.normals) {
        EXPECT_LT((n - Eigen::Vector3f(0, 0, -1)).norm(), 1e-5f) << "it looks at the scanner";
    }
}

TEST_F(MeshFile, TakesVertexColoursAsAlbedo) {
    const char ply[] =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 400 255 255 255\n10 0 400 51 51 51\n0 10 400 0 0 0\n3 0 1 2\n";
    const Scene scene = loadMesh(write("colours.ply", ply), {.in_scanner_frame = true});
    std::vector<float> albedos;
    for (const Material& material : scene.surface.materials) albedos.push_back(material.albedo);
    std::sort(albedos.begin(), albedos.end());
    ASSERT_EQ(albedos.size(), 3u);
    EXPECT_NEAR(albedos[0], 0, 1e-6);
    EXPECT_NEAR(albedos[1], 0.2, 1e-6);
    EXPECT_NEAR(albedos[2], 1, 1e-6);
}

TEST_F(MeshFile, RefusesWhatIsNoMesh) {
    EXPECT_THROW(loadMesh(testing::TempDir() + "absent.ply"), std::runtime_error);
    EXPECT_THROW(loadMesh(write("words.ply", "not a mesh")), std::runtime_error);
    EXPECT_THROW(loadMesh(write("points.obj", "v 0 0 0\nv 1 0 0\n")), std::runtime_error);
}

}  // namespace
}  // namespace facescan::sim
