#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/image.h"
#include "reconstruct/mesh.h"

/// Other people's readers, to judge the files by.
namespace facescan::test {

/// What a mesh says at one corner of one triangle, however its file shares vertices.
struct Corner {
    std::array<float, 3> position{};
    std::array<float, 3> normal{};
    std::array<float, 2> texture{};  ///< origin at the bottom left
};
using Facet = std::array<Corner, 3>;

struct PeerMesh {
    std::vector<Facet> facets;
    bool has_normals = false;
    bool has_texture = false;
    std::string texture_file;   ///< as the mesh names it; "*0" where it is embedded
    std::string texture_bytes;  ///< of the embedded file
};

/// Reads a mesh file by Assimp. Records a test failure, and returns nothing, where it cannot.
PeerMesh readByAssimp(const std::filesystem::path& file);

/// Decodes a PNG file's bytes by stb_image; `channels` receives how many the file has.
GreyImage decodeByStb(std::string_view png, int* channels = nullptr);

/// Encodes a PNG by stb_image_write.
std::string encodeByStb(const GreyImage& image, int channels = 1);

/// The mesh as facets, to compare with a peer's.
std::vector<Facet> facetsOf(const Mesh& mesh);

/// The pixel that the peer's convention puts at texture coordinates (u, v), v upwards.
std::uint8_t sampleNearest(const GreyImage& image, const std::array<float, 2>& uv);

/// The normal that a facet's winding gives, not normalised.
std::array<float, 3> windingNormal(const Facet& facet);

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b);

}  // namespace facescan::test
