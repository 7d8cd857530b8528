#include "render/gl_context.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "render/render_error.h"

namespace facescan {
namespace {

namespace fs = std::filesystem;

/// Opens a context and ends the process: status 0, or 3 with the error's text on standard error.
[[noreturn]] void openContextAndExit() {
    try {
        const GlContext context = GlContext::surfaceless();
    } catch (const RenderError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        std::exit(3);
    }
    std::exit(0);
}

/// Runs each case in a process of its own, started afresh, where no driver is loaded yet.
class GlContextWithoutADriver : public ::testing::Test {
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

    void TearDown() override {
        for (const char* name :
             {"LD_LIBRARY_PATH", "__EGL_VENDOR_LIBRARY_DIRS", "LIBGL_DRIVERS_PATH"}) {
            unsetenv(name);
        }
        fs::remove_all(folder_);
    }

    /// A library in front of the real one that the loader cannot open.
    void breakLibrary(const char* file) {
        fs::create_directories(folder_);
        std::ofstream(folder_ / file).close();
        setenv("LD_LIBRARY_PATH", folder_.c_str(), 1);
    }

private:
    fs::path folder_ = fs::path(::testing::TempDir()) /
                       (std::string("facescan_") +
                        ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(GlContextWithoutADriver, AMissingEglLibraryIsAnErrorThatNamesItsPackage) {
    breakLibrary("libEGL.so.1");
    EXPECT_EXIT(openContextAndExit(), ::testing::ExitedWithCode(3),
                "EGL: no libEGL.so.1: install libegl1");
}

TEST_F(GlContextWithoutADriver, AMissingGlesLibraryIsAnErrorThatNamesItsPackage) {
    breakLibrary("libGLESv2.so.2");
    EXPECT_EXIT(openContextAndExit(), ::testing::ExitedWithCode(3),
                "EGL: no libGLESv2.so.2: install libgles2");
}

TEST_F(GlContextWithoutADriver, AMissingEglVendorIsAnErrorThatNamesItsPackage) {
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    EXPECT_EXIT(openContextAndExit(), ::testing::ExitedWithCode(3),
                "EGL: no surfaceless platform: install libegl-mesa0");
}

TEST_F(GlContextWithoutADriver, AMissingGpuDriverIsAnErrorThatNamesItsPackage) {
    setenv("LIBGL_DRIVERS_PATH", "/nonexistent", 1);
    EXPECT_EXIT(openContextAndExit(), ::testing::ExitedWithCode(3),
                "EGL: the surfaceless display does not start: install libgl1-mesa-dri");
}

TEST(GlContext, OpensAndClosesRepeatedly) {
    for (int i = 0; i < 3; ++i) {
        const GlContext context = GlContext::surfaceless();
        const GlContext::Current current(context);
    }
}

TEST(GlContext, IsUsableOnOneThreadAfterAnother) {
    const GlContext context = GlContext::surfaceless();
    { const GlContext::Current current(context); }
    std::thread([&] { EXPECT_NO_THROW(GlContext::Current{context}); }).join();
    EXPECT_NO_THROW(GlContext::Current{context});
}

TEST(GlContext, RefusesTwoThreadsAtATime) {
    const GlContext context = GlContext::surfaceless();
    const GlContext::Current current(context);
    std::thread([&] { EXPECT_THROW(GlContext::Current{context}, RenderError); }).join();
}

}  // namespace
}  // namespace facescan
