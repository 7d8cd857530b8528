#pragma once

#include <memory>

#include "reconstruct/image.h"
#include "reconstruct/mesh.h"
#include "render/camera_view.h"
#include "render/rgb_image.h"

namespace facescan {

struct PreviewOptions {
    int width = 1280;  ///< px, both halves together; 2 … 8192
    int height = 960;  ///< px, 1 … 8192
    Viewpoint viewpoint{.right_deg = 20, .up_deg = 6};
};

/// Draws previews: on the left the mesh with its texture, on the right the same view as matte grey
/// plaster, where flaws show. An empty mesh leaves the background.
///
/// The same input gives the same bytes on the same driver. Setting up takes some 100 ms, so keep
/// one for a batch. Usable on any thread, by one at a time.
class PreviewRenderer {
public:
    /// @throws RenderError when there is no way to draw on this machine
    PreviewRenderer();
    PreviewRenderer(PreviewRenderer&&) noexcept;
    PreviewRenderer& operator=(PreviewRenderer&&) noexcept;
    ~PreviewRenderer();

    /// @param mesh     every index names a vertex
    /// @param texture  any size; empty for plain grey
    /// @throws RenderError when the size is out of range or more than the driver can draw
    RgbImage render(const Mesh& mesh, const GreyImage& texture, const PreviewOptions& options = {});

private:
    struct Studio;
    std::unique_ptr<Studio> studio_;
};

/// A single preview: sets up, draws and takes down.
/// @throws RenderError as PreviewRenderer does
RgbImage renderPreview(const Mesh& mesh, const GreyImage& texture,
                       const PreviewOptions& options = {});

}  // namespace facescan
