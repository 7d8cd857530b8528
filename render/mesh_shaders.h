#pragma once

namespace facescan {

/// From the scanner's frame to the picture. Normals come in eye space.
inline constexpr char kMeshVertexShader[] = R"(
    uniform mat4 view;
    uniform mat4 projection;
    attribute vec3 position;
    attribute vec3 normal;
    attribute vec2 texture_place;
    attribute float quality;
    varying vec3 seen_normal;
    varying vec2 place;
    varying float filled;
    void main() {
        seen_normal = mat3(view) * normal;
        place = vec2(texture_place.x, 1.0 - texture_place.y);
        filled = quality > 0.0 ? 0.0 : 1.0;
        gl_Position = projection * (view * vec4(position, 1.0));
    }
)";

/// The photograph in a slightly warm tone, a little darker where the surface turns away from a lamp
/// at the upper right.
inline constexpr char kTexturedFragmentShader[] = R"(
    precision mediump float;
    uniform sampler2D photograph;
    varying vec3 seen_normal;
    varying vec2 place;
    void main() {
        vec3 n = normalize(seen_normal);
        float lamp = max(dot(n, normalize(vec3(0.45, 0.55, 0.7))), 0.0);
        float grey = texture2D(photograph, place).r;
        vec3 tone = mix(vec3(0.055, 0.045, 0.04), vec3(1.0, 0.95, 0.89), grey);
        gl_FragColor = vec4(tone * (0.66 + 0.5 * lamp), 1.0);
    }
)";

/// Plaster under a warm key light at the upper right and a cool, weak one at the left; summed in
/// linear light and shown with a gamma of 2. Both reach round the edge of their shade, so that
/// flaws show there too. Filled places are tinted blue.
inline constexpr char kMatteFragmentShader[] = R"(
    precision mediump float;
    varying vec3 seen_normal;
    varying float filled;
    float light(vec3 normal, vec3 direction, float reach) {
        float lit = max((dot(normal, normalize(direction)) + reach) / (1.0 + reach), 0.0);
        return lit * lit;
    }
    void main() {
        vec3 n = normalize(seen_normal);
        vec3 plaster = mix(vec3(0.76, 0.74, 0.72), vec3(0.48, 0.61, 0.78), filled);
        vec3 received = light(n, vec3(0.62, 0.62, 0.48), 0.45) * vec3(1.0, 0.96, 0.90)
                      + light(n, vec3(-0.85, 0.1, 0.5), 0.6) * vec3(0.13, 0.15, 0.19);
        gl_FragColor = vec4(sqrt(plaster * received), 1.0);
    }
)";

}  // namespace facescan
