#include "export/peer.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <memory>

namespace facescan::test {
namespace {

std::array<float, 3> toArray(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

Corner cornerOf(const aiMesh& mesh, unsigned index) {
    Corner corner;
    corner.position = toArray(mesh.mVertices[index]);
    if (mesh.HasNormals()) corner.normal = toArray(mesh.mNormals[index]);
    if (mesh.HasTextureCoords(0)) {
        corner.texture = {mesh.mTextureCoords[0][index].x, mesh.mTextureCoords[0][index].y};
    }
    return corner;
}

void takeTexture(const aiScene& scene, PeerMesh& result) {
    const aiMaterial& material = *scene.mMaterials[scene.mMeshes[0]->mMaterialIndex];
    aiString name;
    if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS) return;
    result.texture_file = name.C_Str();
    if (const aiTexture* embedded = scene.GetEmbeddedTexture(name.C_Str())) {
        // A height of 0 says that the data is a file of mWidth bytes.
        EXPECT_EQ(embedded->mHeight, 0u);
        result.texture_bytes.assign(reinterpret_cast<const char*>(embedded->pcData),
                                    embedded->mWidth);
    }
}

}  // namespace

PeerMesh readByAssimp(const std::filesystem::path& file) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(
        file.string(), aiProcess_ValidateDataStructure | aiProcess_PreTransformVertices);
    PeerMesh result;
    if (scene == nullptr || scene->mNumMeshes != 1) {
        ADD_FAILURE() << "Assimp does not find one mesh in " << file << ": "
                      << importer.GetErrorString();
        return result;
    }
    const aiMesh& mesh = *scene->mMeshes[0];
    result.has_normals = mesh.HasNormals();
    result.has_texture = mesh.HasTextureCoords(0);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        EXPECT_EQ(mesh.mFaces[f].mNumIndices, 3u);
        Facet facet;
        for (int k = 0; k < 3; ++k) facet[k] = cornerOf(mesh, mesh.mFaces[f].mIndices[k]);
        result.facets.push_back(facet);
    }
    takeTexture(*scene, result);
    return result;
}

GreyImage decodeByStb(std::string_view png, int* channels) {
    GreyImage image;
    int in_file = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()), int(png.size()),
                              &image.width, &image.height, &in_file, 0),
        stbi_image_free);
    if (!pixels) {
        ADD_FAILURE() << "stb_image: " << stbi_failure_reason();
        return image;
    }
    if (channels != nullptr) *channels = in_file;
    image.pixels.assign(pixels.get(),
                        pixels.get() + std::size_t(image.width) * image.height * in_file);
    return image;
}

std::string encodeByStb(const GreyImage& image, int channels) {
    std::string png;
    const auto append = [](void* out, void* data, int size) {
        static_cast<std::string*>(out)->append(static_cast<char*>(data), std::size_t(size));
    };
    stbi_write_png_to_func(append, &png, image.width / channels, image.height, channels,
                           image.pixels.data(), image.width);
    return png;
}

std::vector<Facet> facetsOf(const Mesh& mesh) {
    std::vector<Facet> facets;
    for (const Triangle& triangle : mesh.triangles) {
        Facet facet;
        for (int k = 0; k < 3; ++k) {
            const Vertex& v = mesh.vertices[triangle[k]];
            facet[k] = {{v.x, v.y, v.z}, {v.nx, v.ny, v.nz}, {v.s, v.t}};
        }
        facets.push_back(facet);
    }
    return facets;
}

std::uint8_t sampleNearest(const GreyImage& image, const std::array<float, 2>& uv) {
    const int x = std::clamp(int(uv[0] * float(image.width)), 0, image.width - 1);
    const int y = std::clamp(int((1 - uv[1]) * float(image.height)), 0, image.height - 1);
    return image.row(y)[x];
}

std::array<float, 3> windingNormal(const Facet& facet) {
    std::array<float, 3> u;
    std::array<float, 3> v;
    for (int k = 0; k < 3; ++k) {
        u[k] = facet[1].position[k] - facet[0].position[k];
        v[k] = facet[2].position[k] - facet[0].position[k];
    }
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace facescan::test
