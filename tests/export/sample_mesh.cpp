#include "export/sample_mesh.h"

#include <cmath>

namespace facescan::test {
namespace {

constexpr int kColumns = 12;
constexpr int kRows = 9;
constexpr int kStep = 4;  // px
constexpr int kTextureWidth = kColumns * kStep;
constexpr int kTextureHeight = kRows * kStep;

Vertex vertexAt(Pixel pixel) {
    const float x = 0.4f * float(pixel.x - kTextureWidth / 2);
    const float y = 0.4f * float(pixel.y - kTextureHeight / 2);
    const float dz_dx = 0.02f * x;
    const float dz_dy = 0.3f;
    const float length = std::sqrt(dz_dx * dz_dx + dz_dy * dz_dy + 1);
    return {.x = x,
            .y = y,
            .z = 400 + 0.01f * x * x + 0.3f * y,
            .nx = dz_dx / length,
            .ny = dz_dy / length,
            .nz = -1 / length,
            .s = (float(pixel.x) + 0.5f) / kTextureWidth,
            .t = 1 - (float(pixel.y) + 0.5f) / kTextureHeight,
            .quality = 0.75f};
}

}  // namespace

Pixel samplePixel(std::size_t index) {
    return {int(index) % kColumns * kStep + 2, int(index) / kColumns * kStep + 2};
}

Mesh sampleMesh() {
    Mesh mesh;
    for (std::size_t k = 0; k < kColumns * kRows; ++k) {
        mesh.vertices.push_back(vertexAt(samplePixel(k)));
    }
    mesh.vertices[0].quality = 0;
    for (std::uint32_t row = 0; row + 1 < kRows; ++row) {
        for (std::uint32_t column = 0; column + 1 < kColumns; ++column) {
            // Y points down, so down and then right turns counter-clockwise for the camera.
            const std::uint32_t corner = row * kColumns + column;
            const std::uint32_t right = corner + 1;
            const std::uint32_t below = corner + kColumns;
            mesh.triangles.push_back({corner, below, right});
            mesh.triangles.push_back({right, below, below + 1});
        }
    }
    return mesh;
}

GreyImage markedTexture(Pixel mark) {
    GreyImage texture{kTextureWidth, kTextureHeight, {}};
    texture.pixels.assign(std::size_t(kTextureWidth) * kTextureHeight, 0);
    texture.row(mark.y)[mark.x] = 255;
    return texture;
}

}  // namespace facescan::test
