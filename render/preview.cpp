#include "render/preview.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/backdrop.h"
#include "render/gl_context.h"
#include "render/mesh_renderer.h"
#include "render/offscreen_target.h"
#include "render/render_error.h"

namespace facescan {
namespace {

/// Antialiasing: each pixel is the mean of a square of samples this wide. It needs no extension of
/// GLES 2.0, and smooths texture and shading as well as outlines.
constexpr int kSamples = 2;

constexpr int kLargestSide = 8192;

/// The columns x … x + width − 1 of the preview.
struct Panel {
    int x;
    int width;
    Shading shading;
};

void requireSane(const PreviewOptions& options) {
    const auto within = [](int value, int least) {
        return value >= least && value <= kLargestSide;
    };
    if (!within(options.width, 2) || !within(options.height, 1)) {
        throw RenderError("preview: " + std::to_string(options.width) + " × " +
                          std::to_string(options.height) + " px: ask for 2 × 1 to " +
                          std::to_string(kLargestSide) + " × " + std::to_string(kLargestSide));
    }
}

void requireNoGlError() {
    const GLenum error = glGetError();
    if (error == GL_OUT_OF_MEMORY) {
        throw RenderError("OpenGL ES: out of memory: ask for a smaller picture");
    }
    if (error != GL_NO_ERROR) {
        throw RenderError("OpenGL ES: error " + std::to_string(error) + " while drawing");
    }
}

/// Averages the samples (RGBA, bottom row first) into a panel of the picture.
void resolve(const std::vector<std::uint8_t>& samples, const Panel& panel, RgbImage& picture) {
    static_assert(kSamples == 2);
    constexpr std::size_t kSampleBytes = 4;
    const std::size_t row_bytes = kSampleBytes * kSamples * panel.width;
    for (int y = 0; y < picture.height; ++y) {
        const std::uint8_t* in = samples.data() + row_bytes * kSamples * (picture.height - 1 - y);
        std::uint8_t* out = picture.row(y) + std::size_t{3} * panel.x;
        for (int x = 0; x < panel.width; ++x, in += kSampleBytes * kSamples, out += 3) {
            const std::uint8_t* above = in + row_bytes;
            for (std::size_t c = 0; c < 3; ++c) {
                const int sum = in[c] + in[c + kSampleBytes] + above[c] + above[c + kSampleBytes];
                out[c] = std::uint8_t((sum + 2) / 4);
            }
        }
    }
}

}  // namespace

/// The context, and what lives in it: built up and taken down while the context is current.
struct PreviewRenderer::Studio {
    struct Furniture {
        Backdrop backdrop;
        MeshRenderer mesh;
        std::optional<OffscreenTarget> target;
    };

    Studio() {
        const GlContext::Current current(context);
        furniture.emplace();
    }

    ~Studio() {
        try {
            const GlContext::Current current(context);
            furniture.reset();
        } catch (const RenderError&) {
            // The driver is gone; what lived in the context goes with it.
        }
    }

    OffscreenTarget& targetOf(int width, int height) {
        std::optional<OffscreenTarget>& target = furniture->target;
        if (!target || target->width() != width || target->height() != height) {
            target.reset();
            target.emplace(width, height);
        }
        return *target;
    }

    void draw(const Panel& panel, const CameraView& camera, RgbImage& picture) {
        const OffscreenTarget& target = targetOf(panel.width * kSamples, picture.height * kSamples);
        target.bind();
        furniture->backdrop.draw();
        furniture->mesh.draw(camera, panel.shading);
        target.read(samples);
        resolve(samples, panel, picture);
    }

    GlContext context = GlContext::surfaceless();
    std::optional<Furniture> furniture;
    std::vector<std::uint8_t> samples;  ///< kept for the next picture
};

PreviewRenderer::PreviewRenderer() : studio_(std::make_unique<Studio>()) {}
PreviewRenderer::PreviewRenderer(PreviewRenderer&&) noexcept = default;
PreviewRenderer& PreviewRenderer::operator=(PreviewRenderer&&) noexcept = default;
PreviewRenderer::~PreviewRenderer() = default;

RgbImage PreviewRenderer::render(const Mesh& mesh, const GreyImage& texture,
                                 const PreviewOptions& options) {
    requireSane(options);
    RgbImage picture{options.width, options.height, {}};
    picture.pixels.resize(std::size_t(3) * options.width * options.height);

    const int left = options.width / 2;
    const int right = options.width - left;
    const CameraView camera =
        frameMesh(mesh, options.viewpoint, float(right) / float(options.height));

    const GlContext::Current current(studio_->context);
    studio_->furniture->mesh.upload(mesh, texture);
    studio_->draw({0, left, Shading::textured}, camera, picture);
    studio_->draw({left, right, Shading::matte}, camera, picture);
    requireNoGlError();
    return picture;
}

RgbImage renderPreview(const Mesh& mesh, const GreyImage& texture, const PreviewOptions& options) {
    return PreviewRenderer().render(mesh, texture, options);
}

}  // namespace facescan
