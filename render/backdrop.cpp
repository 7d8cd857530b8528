#include "render/backdrop.h"

namespace facescan {
namespace {

constexpr char kVertexShader[] = R"(
    attribute vec2 corner;
    varying vec2 place;
    void main() {
        place = corner;
        gl_Position = vec4(corner, 0.0, 1.0);
    }
)";

constexpr char kFragmentShader[] = R"(
    precision mediump float;
    varying vec2 place;
    void main() {
        float away = length(place - vec2(0.0, 0.25)) / 1.6;
        gl_FragColor = vec4(mix(vec3(0.185, 0.195, 0.21), vec3(0.07, 0.075, 0.085),
                                smoothstep(0.0, 1.0, away)), 1.0);
    }
)";

/// One triangle that covers the viewport: a quad's diagonal would be drawn twice.
constexpr float kCorners[] = {-1, -1, 3, -1, -1, 3};

}  // namespace

Backdrop::Backdrop() : program_(kVertexShader, kFragmentShader, {"corner"}) {
    glBindBuffer(GL_ARRAY_BUFFER, corners_.id());
    glBufferData(GL_ARRAY_BUFFER, sizeof kCorners, kCorners, GL_STATIC_DRAW);
}

void Backdrop::draw() const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    program_.use();
    glBindBuffer(GL_ARRAY_BUFFER, corners_.id());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisableVertexAttribArray(0);
}

}  // namespace facescan
