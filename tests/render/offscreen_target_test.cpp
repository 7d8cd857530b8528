#include "render/offscreen_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/gl_context.h"
#include "render/render_error.h"

namespace facescan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class OffscreenTargetTest : public ::testing::Test {
    GlContext context_ = GlContext::surfaceless();
    GlContext::Current current_{context_};
};

TEST_F(OffscreenTargetTest, ReadsWhatWasDrawnTheBottomRowFirst) {
    const OffscreenTarget target(2, 2);
    target.bind();
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(1, 0, 1, 1);  // OpenGL counts from the bottom left
    glClearColor(1, 0.2f, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    std::vector<std::uint8_t> rgba;
    target.read(rgba);
    EXPECT_THAT(rgba, ElementsAre(0, 0, 0, 255, 255, 51, 0, 255,  //
                                  0, 0, 0, 255, 0, 0, 0, 255));
}

TEST_F(OffscreenTargetTest, BindingSetsTheViewportToTheWholePicture) {
    const OffscreenTarget target(30, 20);
    target.bind();
    GLint viewport[4];
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_THAT(viewport, ElementsAre(0, 0, 30, 20));
}

TEST_F(OffscreenTargetTest, TwoPicturesDoNotDisturbEachOther) {
    const OffscreenTarget first(1, 1);
    const OffscreenTarget second(1, 1);
    std::vector<std::uint8_t> rgba;
    first.bind();
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    second.bind();
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    first.read(rgba);
    EXPECT_THAT(rgba, ElementsAre(255, 255, 255, 255));
}

TEST_F(OffscreenTargetTest, APictureTooLargeForTheDriverIsAnErrorThatNamesTheLimit) {
    try {
        const OffscreenTarget target(1'000'000, 10);
        FAIL();
    } catch (const RenderError& error) {
        EXPECT_THAT(error.what(), HasSubstr("1000000 × 10: at most "));
    }
}

}  // namespace
}  // namespace facescan
