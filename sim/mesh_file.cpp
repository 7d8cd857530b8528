#include "sim/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <numbers>
#include <stdexcept>

namespace facescan::sim {

namespace {

void append(const aiMesh& mesh, const Material& material, Surface& surface) {
    const auto first = std::uint32_t(surface.positions.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& p = mesh.mVertices[i];
        surface.positions.emplace_back(p.x, p.y, p.z);
        Material own = material;
        if (mesh.HasVertexColors(0)) {
            const aiColor4D& c = mesh.mColors[0][i];
            own.albedo = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
        }
        surface.materials.push_back(own);
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) continue;
        surface.triangles.push_back(
            {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
}

Eigen::AlignedBox3d boundsOf(const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& p : surface.positions) box.extend(p.cast<double>());
    return box;
}

void place(Scene& scene, const MeshPlacement& placement) {
    const double yaw = placement.yaw_deg * std::numbers::pi / 180;
    const Eigen::Matrix3d to_scanner =
        Eigen::Vector3d(1, -1, -1).asDiagonal() *
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()).toRotationMatrix();
    const double height = boundsOf(scene.surface).sizes().y();
    const double scale = placement.height_mm > 0 && height > 0 ? placement.height_mm / height : 1;
    for (Eigen::Vector3f& p : scene.surface.positions) p *= float(scale);
    scene = transformed(std::move(scene), {to_scanner, Eigen::Vector3d::Zero()});
    const Eigen::AlignedBox3d box = boundsOf(scene.surface);
    const Eigen::Vector3d shift(placement.offset_x_mm - box.center().x(),
                                placement.offset_y_mm - box.center().y(),
                                placement.nearest_mm - box.min().z());
    scene = transformed(std::move(scene), {Eigen::Matrix3d::Identity(), shift});
}

}  // namespace

Scene loadMesh(const std::filesystem::path& path, const MeshPlacement& placement) {
    Assimp::Importer importer;
    const aiScene* file = importer.ReadFile(
        path.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                           aiProcess_PreTransformVertices | aiProcess_FindInvalidData);
    if (!file) {
        throw std::runtime_error(path.string() +
                                 ": cannot read as a mesh: " + importer.GetErrorString());
    }
    Scene scene{.kind = "mesh"};
    for (unsigned i = 0; i < file->mNumMeshes; ++i) {
        append(*file->mMeshes[i], placement.material, scene.surface);
    }
    if (scene.surface.triangles.empty()) {
        throw std::runtime_error(path.string() + ": holds no triangles: expected a surface");
    }
    computeNormals(scene.surface);
    if (!placement.in_scanner_frame) place(scene, placement);
    return scene;
}

}  // namespace facescan::sim
