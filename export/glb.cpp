#include "export/glb.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace facescan {
namespace {

/// A vertex as it lies in the buffer, in glTF's frame.
struct GltfVertex {
    std::array<float, 3> position;  ///< m
    std::array<float, 3> normal;
    std::array<float, 2> texture;  ///< origin at the top left
};
static_assert(sizeof(GltfVertex) == 8 * sizeof(float));

GltfVertex toGltf(const Vertex& v) {
    return {{v.x / 1000, -v.y / 1000, -v.z / 1000}, {v.nx, -v.ny, -v.nz}, {v.s, 1 - v.t}};
}

/// Appends bytes to the model's only buffer, as a buffer view; returns the view's index.
int addView(tinygltf::Model& model, const void* data, std::size_t size, int target,
            std::size_t stride = 0) {
    std::vector<unsigned char>& buffer = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = size;
    view.byteStride = stride;
    view.target = target;
    const auto* bytes = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), bytes, bytes + size);
    model.bufferViews.push_back(view);
    return int(model.bufferViews.size()) - 1;
}

int addAccessor(tinygltf::Model& model, int view, std::size_t offset, std::size_t count,
                int component_type, int type) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.byteOffset = offset;
    accessor.count = count;
    accessor.componentType = component_type;
    accessor.type = type;
    model.accessors.push_back(accessor);
    return int(model.accessors.size()) - 1;
}

/// The bounding box, which glTF demands of positions.
void setBounds(tinygltf::Accessor& accessor, const std::vector<GltfVertex>& vertices) {
    accessor.minValues.assign(3, std::numeric_limits<double>::max());
    accessor.maxValues.assign(3, std::numeric_limits<double>::lowest());
    for (const GltfVertex& vertex : vertices) {
        for (int k = 0; k < 3; ++k) {
            const double value = vertex.position[k];
            accessor.minValues[k] = std::min(accessor.minValues[k], value);
            accessor.maxValues[k] = std::max(accessor.maxValues[k], value);
        }
    }
}

tinygltf::Primitive addSurface(tinygltf::Model& model, const Mesh& mesh) {
    std::vector<GltfVertex> vertices(mesh.vertices.size());
    std::ranges::transform(mesh.vertices, vertices.begin(), toGltf);

    const int vertex_view = addView(model, vertices.data(), vertices.size() * sizeof(GltfVertex),
                                    TINYGLTF_TARGET_ARRAY_BUFFER, sizeof(GltfVertex));
    const int index_view =
        addView(model, mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle),
                TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    const auto attribute = [&](std::size_t offset, int type) {
        return addAccessor(model, vertex_view, offset, vertices.size(),
                           TINYGLTF_COMPONENT_TYPE_FLOAT, type);
    };

    tinygltf::Primitive surface;
    surface.mode = TINYGLTF_MODE_TRIANGLES;
    surface.attributes["POSITION"] = attribute(offsetof(GltfVertex, position), TINYGLTF_TYPE_VEC3);
    setBounds(model.accessors[surface.attributes["POSITION"]], vertices);
    surface.attributes["NORMAL"] = attribute(offsetof(GltfVertex, normal), TINYGLTF_TYPE_VEC3);
    surface.attributes["TEXCOORD_0"] = attribute(offsetof(GltfVertex, texture), TINYGLTF_TYPE_VEC2);
    surface.indices = addAccessor(model, index_view, 0, 3 * mesh.triangles.size(),
                                  TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    return surface;
}

/// A matt material of the texture's colour; returns its index.
int addMaterial(tinygltf::Model& model, std::string_view texture_png) {
    tinygltf::Image image;
    image.name = "texture";
    image.mimeType = "image/png";
    image.bufferView = addView(model, texture_png.data(), texture_png.size(), 0);
    model.images.push_back(std::move(image));

    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model.samplers.push_back(sampler);

    tinygltf::Texture texture;
    texture.sampler = 0;
    texture.source = 0;
    model.textures.push_back(texture);

    tinygltf::Material material;
    material.name = "face";
    material.doubleSided = true;
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
    material.pbrMetallicRoughness.metallicFactor = 0;
    model.materials.push_back(material);
    return 0;
}

void addMesh(tinygltf::Model& model, const Mesh& mesh, std::string_view texture_png) {
    model.buffers.emplace_back();
    tinygltf::Mesh surface;
    surface.name = "face";
    surface.primitives.push_back(addSurface(model, mesh));
    surface.primitives[0].material = addMaterial(model, texture_png);
    model.meshes.push_back(std::move(surface));
}

}  // namespace

void formatGlb(const Mesh& mesh, std::string_view texture_png, std::string& out) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "facescan";
    tinygltf::Node node;
    node.name = "face";
    if (!mesh.triangles.empty()) {
        addMesh(model, mesh, texture_png);
        node.mesh = 0;
    }
    model.nodes.push_back(node);
    model.scenes.emplace_back().nodes = {0};
    model.defaultScene = 0;

    std::ostringstream stream;
    const bool pretty = false;
    const bool binary = true;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, pretty, binary)) {
        throw std::runtime_error("GLB: the file could not be composed");
    }
    out = std::move(stream).str();
}

}  // namespace facescan
