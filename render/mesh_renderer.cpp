#include "render/mesh_renderer.h"

#include <algorithm>
#include <cstddef>

#include "render/mesh_shaders.h"
#include "render/texture_fit.h"

namespace facescan {
namespace {

/// More than a picture of the mesh can show, and what every GPU can have.
constexpr int kLargestTexture = 2048;

/// A vertex attribute: its place in `Vertex`, in the order of its locations.
struct Attribute {
    GLint size;
    std::size_t offset;
};
constexpr Attribute kAttributes[] = {{3, offsetof(Vertex, x)},
                                     {3, offsetof(Vertex, nx)},
                                     {2, offsetof(Vertex, s)},
                                     {1, offsetof(Vertex, quality)}};

void enableAttributes() {
    for (GLuint location = 0; location < std::size(kAttributes); ++location) {
        const Attribute& attribute = kAttributes[location];
        glEnableVertexAttribArray(location);
        // OpenGL takes an offset into the bound buffer as a pointer.
        // NOLINTNEXTLINE(performance-no-int-to-ptr)
        const void* offset = reinterpret_cast<const void*>(attribute.offset);
        glVertexAttribPointer(location, attribute.size, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset);
    }
}

void disableAttributes() {
    for (GLuint location = 0; location < std::size(kAttributes); ++location) {
        glDisableVertexAttribArray(location);
    }
}

}  // namespace

MeshRenderer::MeshRenderer()
    : textured_(kMeshVertexShader, kTexturedFragmentShader,
                {"position", "normal", "texture_place", "quality"}),
      matte_(kMeshVertexShader, kMatteFragmentShader,
             {"position", "normal", "texture_place", "quality"}) {}

void MeshRenderer::upload(const Mesh& mesh, const GreyImage& texture) {
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh.vertices.size() * sizeof(Vertex)),
                 mesh.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(mesh.triangles.size() * sizeof(Triangle)),
                 mesh.triangles.data(), GL_STATIC_DRAW);
    index_count_ = GLsizei(mesh.triangles.size() * 3);
    uploadTexture(texture);
}

void MeshRenderer::uploadTexture(const GreyImage& texture) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const GreyImage fitted = texture.pixels.empty()
                                 ? GreyImage{1, 1, {128}}
                                 : fitTexture(texture, std::min<int>(largest, kLargestTexture));

    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, fitted.width, fitted.height, 0, GL_LUMINANCE,
                 GL_UNSIGNED_BYTE, fitted.pixels.data());
}

void MeshRenderer::draw(const CameraView& camera, Shading shading) const {
    if (index_count_ == 0) return;
    const GlProgram& program = shading == Shading::textured ? textured_ : matte_;
    program.use();
    glUniformMatrix4fv(program.uniform("view"), 1, GL_FALSE, camera.view.data());
    glUniformMatrix4fv(program.uniform("projection"), 1, GL_FALSE, camera.projection.data());

    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    enableAttributes();
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    disableAttributes();
}

}  // namespace facescan
