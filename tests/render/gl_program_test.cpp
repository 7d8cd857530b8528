#include "render/gl_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/gl_context.h"
#include "render/render_error.h"

namespace facescan {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kVertex[] = R"(
    uniform mat4 view;
    attribute vec3 first;
    attribute vec2 second;
    varying vec2 place;
    void main() {
        place = second;
        gl_Position = view * vec4(first, 1.0);
    }
)";
constexpr char kFragment[] = R"(
    precision mediump float;
    varying vec2 place;
    void main() { gl_FragColor = vec4(place, 0.0, 1.0); }
)";

class GlProgramTest : public ::testing::Test {
    GlContext context_ = GlContext::surfaceless();
    GlContext::Current current_{context_};
};

TEST_F(GlProgramTest, AttributesHaveTheLocationsOfTheirOrder) {
    const GlProgram program(kVertex, kFragment, {"second", "first"});
    program.use();
    GLint id = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &id);
    EXPECT_EQ(glGetAttribLocation(id, "second"), 0);
    EXPECT_EQ(glGetAttribLocation(id, "first"), 1);
    EXPECT_GE(program.uniform("view"), 0);
}

TEST_F(GlProgramTest, ARejectedShaderIsAnErrorOfOneLine) {
    for (const char* broken : {"void main() { nonsense }", "", "precision mediump float;"}) {
        try {
            const GlProgram program(kVertex, broken, {"first", "second"});
            FAIL() << broken;
        } catch (const RenderError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("shader"), Not(HasSubstr("\n"))));
        }
    }
}

}  // namespace
}  // namespace facescan
