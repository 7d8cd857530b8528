#pragma once

#include "reconstruct/image.h"
#include "reconstruct/mesh.h"
#include "render/camera_view.h"
#include "render/gl_object.h"
#include "render/gl_program.h"

namespace facescan {

/// How a mesh looks.
enum class Shading {
    textured,  ///< as photographed, with a breath of light so that relief shows
    matte,     ///< grey plaster under two lights, which shows every flaw; filled vertices tinted
};

/// Holds one textured mesh in the GPU's memory and draws it into the bound framebuffer: off-screen
/// or on a display. The context it was made in is current when it is used and when it goes.
///
/// Faces turned away from the eye are not drawn.
class MeshRenderer {
public:
    MeshRenderer();

    /// Replaces the mesh. Every index of it names a vertex. A texture with a side of more than
    /// 2048 px, or more than the GPU can have, is made smaller; without pixels it is plain grey.
    void upload(const Mesh& mesh, const GreyImage& texture);

    void draw(const CameraView& camera, Shading shading) const;

private:
    void uploadTexture(const GreyImage& texture);

    GlProgram textured_;
    GlProgram matte_;
    GlBuffer vertices_;
    GlBuffer indices_;
    GlTexture texture_;
    GLsizei index_count_ = 0;
};

}  // namespace facescan
