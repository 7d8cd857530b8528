#pragma once

#include "reconstruct/image.h"
#include "reconstruct/mesh.h"

namespace facescan::test {

/// A patch of 12 × 9 vertices that looks like none of its mirror images: the surface
/// z = 400 + 0.01 x² + 0.3 y (mm), 0.4 mm a texture pixel, a vertex on every fourth pixel of a
/// texture of 48 × 36. Normals in closed form; the first vertex is marked as filled in.
Mesh sampleMesh();

/// The texture pixel on which vertex `index` of the patch lies.
struct Pixel {
    int x;
    int y;
    friend bool operator==(const Pixel&, const Pixel&) = default;
};
Pixel samplePixel(std::size_t index);

/// The patch's texture: black but for one white pixel.
GreyImage markedTexture(Pixel mark);

}  // namespace facescan::test
