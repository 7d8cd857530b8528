#include "render/gl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string>
#include <utility>

#include "render/render_error.h"

namespace facescan {
namespace {

/// libepoxy ends the process where it cannot open a library, so look first. The library stays open:
/// epoxy keeps pointers into it.
void requireLibrary(const char* file, const char* package) {
    if (!dlopen(file, RTLD_LAZY)) {
        throw RenderError(std::string("EGL: no ") + file + ": install " + package);
    }
}

EGLDisplay openSurfacelessDisplay() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        throw RenderError("EGL: no surfaceless platform: install libegl-mesa0 and libgl1-mesa-dri");
    }
    EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
        throw RenderError(
            "EGL: the surfaceless display does not start: install libgl1-mesa-dri, or set "
            "LIBGL_ALWAYS_SOFTWARE=1 to do without the GPU");
    }
    return display;
}

EGLContext createContext(EGLDisplay display) {
    const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_ES2_BIT, EGL_NONE};
    const EGLint context_attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};

    EGLConfig config = nullptr;
    EGLint found = 0;
    eglBindAPI(EGL_OPENGL_ES_API);
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context") ||
        !eglChooseConfig(display, config_attributes, &config, 1, &found) || found == 0) {
        throw RenderError(
            "EGL: the driver has no OpenGL ES 2.0 off-screen: install libgl1-mesa-dri");
    }
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
    if (context == EGL_NO_CONTEXT) {
        throw RenderError("EGL: no OpenGL ES 2.0 context: install libgl1-mesa-dri");
    }
    return context;
}

}  // namespace

GlContext GlContext::surfaceless() {
    requireLibrary("libEGL.so.1", "libegl1");
    requireLibrary("libGLESv2.so.2", "libgles2");
    // The display is never terminated. EGL hands the same one to every caller in the process, so
    // that ending it here would end it for the others.
    EGLDisplay display = openSurfacelessDisplay();
    GlContext context(display, createContext(display));

    const Current current(context);
    if (!epoxy_has_gl_extension("GL_OES_element_index_uint")) {
        throw RenderError("OpenGL ES: the driver lacks OES_element_index_uint: use Mesa's driver");
    }
    return context;
}

GlContext::GlContext(GlContext&& other) noexcept
    : display_(other.display_), context_(std::exchange(other.context_, EGL_NO_CONTEXT)) {}

GlContext::~GlContext() {
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
}

GlContext::Current::Current(const GlContext& context) : display_(context.display_) {
    eglBindAPI(EGL_OPENGL_ES_API);
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_)) {
        throw RenderError("EGL: the context cannot be used: it is in use on another thread");
    }
}

GlContext::Current::~Current() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace facescan
