#pragma once

namespace facescan {

/// An OpenGL ES 2.0 context of its own, without a window: it draws into framebuffer objects.
///
/// GLES 2.0, because that is what the GPUs of small ARM boards have (Mali-400, VideoCore IV); with
/// OES_element_index_uint, since a scan has more than 65,536 vertices.
///
/// The context belongs to no thread. Whoever draws holds a `Current` for as long as that takes; one
/// thread at a time. What is created in a context is destroyed while it is current.
class GlContext {
public:
    /// Opens Mesa's surfaceless platform: no display server, no device node, llvmpipe where there
    /// is no GPU.
    /// @throws RenderError when a library, the platform or the driver is missing
    static GlContext surfaceless();

    GlContext(GlContext&& other) noexcept;
    GlContext& operator=(GlContext&&) = delete;
    ~GlContext();

    /// Makes a context current on this thread, and no context when it goes.
    class Current {
    public:
        /// @throws RenderError when the context is current on another thread
        explicit Current(const GlContext& context);
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;
        ~Current();

    private:
        void* display_;
    };

private:
    GlContext(void* display, void* context) : display_(display), context_(context) {}

    void* display_;
    void* context_;
};

}  // namespace facescan
