#include "reconstruct/striped_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace facescan::test {
namespace {

struct Gradient {
    double x;
    double y;
};

Gradient gradientOf(const Field& field, double x, double y) {
    constexpr double kStep = 0.5;
    return {field(x + kStep, y) - field(x - kStep, y), field(x, y + kStep) - field(x, y - kStep)};
}

double normalCdf(double x) {
    return 0.5 * std::erfc(-x * (1 / std::numbers::sqrt2));
}

bool isLit(const Pattern& pattern, int pair, bool complement, long stripe) {
    return stripe >= 0 && stripe < pattern.stripes() &&
           pattern.lit(pair, complement, std::uint32_t(stripe));
}

/// The share of lit stripes at `code` when their edges are blurred with `sigma` stripes.
double litShare(const Pattern& pattern, int pair, bool complement, double code, double sigma) {
    const double reach = 6 * sigma;
    const long first = long(std::floor(code - reach));
    const long last = long(std::ceil(code + reach));
    double share = isLit(pattern, pair, complement, first);
    for (long edge = first + 1; edge <= last; ++edge) {
        const int step = int(isLit(pattern, pair, complement, edge)) -
                         int(isLit(pattern, pair, complement, edge - 1));
        if (step != 0) share += step * normalCdf((code - double(edge)) / sigma);
    }
    return share;
}

std::uint8_t greyLevel(double value) {
    return std::uint8_t(std::clamp(std::lround(value), 0L, 255L));
}

/// What a pixel sees, whatever is projected.
struct PixelView {
    double ambient;     ///< grey levels
    double full_light;  ///< grey levels of a lit stripe
    double dark_share;
    double code;        ///< not a number where the projector's light does not reach
    double edge_sigma;  ///< blur of a stripe's edge, stripes

    std::uint8_t level(const Pattern& pattern, int pair, bool complement) const {
        if (!std::isfinite(code) || !std::isfinite(edge_sigma)) return greyLevel(ambient);
        const double share = litShare(pattern, pair, complement, code, edge_sigma);
        return greyLevel(ambient + full_light * (dark_share + (1 - dark_share) * share));
    }
};

PixelView viewOf(const StripedScene& scene, double x, double y) {
    const double variance = scene.camera_blur_px * scene.camera_blur_px;
    const Gradient k = gradientOf(scene.log_reflectance, x, y);
    const double reflectance =
        std::exp(scene.log_reflectance(x, y) + 0.5 * variance * (k.x * k.x + k.y * k.y));
    const Gradient slope = gradientOf(scene.code, x, y);
    const double blur_px = std::hypot(scene.camera_blur_px, scene.projector_blur_px);
    return {.ambient = reflectance * scene.ambient_level,
            .full_light = reflectance * scene.white_level,
            .dark_share = scene.dark_share,
            .code = scene.code(x + variance * k.x, y + variance * k.y),
            .edge_sigma = blur_px * std::hypot(slope.x, slope.y)};
}

std::uint8_t& pixelAt(const Pattern& pattern, int pair, bool complement, int x, int y,
                      FrameStack& stack) {
    const std::size_t frame = stack.view().frameBytes() * pattern.frameIndex(pair, complement);
    return stack.pixels[frame + std::size_t(y) * stack.row_stride + x];
}

}  // namespace

FrameStack blackFrames(const Pattern& pattern, int width, int height) {
    FrameStack stack;
    stack.count = pattern.frameCount();
    stack.width = width;
    stack.height = height;
    stack.row_stride = width;
    stack.pixels.assign(std::size_t(stack.count) * width * height, 0);
    return stack;
}

void drawFrame(const StripedScene& scene, const Pattern& pattern, int pair, bool complement,
               FrameStack& stack) {
    for (int y = 0; y < stack.height; ++y) {
        for (int x = 0; x < stack.width; ++x) {
            pixelAt(pattern, pair, complement, x, y, stack) =
                viewOf(scene, x, y).level(pattern, pair, complement);
        }
    }
}

FrameStack drawScan(const StripedScene& scene, const Pattern& pattern, int width, int height) {
    FrameStack stack = blackFrames(pattern, width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const PixelView view = viewOf(scene, x, y);
            for (int pair = 0; pair < pattern.bits; ++pair) {
                for (const bool complement : {false, true}) {
                    pixelAt(pattern, pair, complement, x, y, stack) =
                        view.level(pattern, pair, complement);
                }
            }
        }
    }
    return stack;
}

ScanDescription wholeFrames(const FrameStack& stack, const Pattern& pattern) {
    ScanDescription scan;
    scan.image = {0, 0, stack.width, stack.height};
    scan.pattern = pattern;
    return scan;
}

void addNoise(double grey_levels, std::uint32_t seed, FrameStack& stack) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, grey_levels);
    for (std::uint8_t& pixel : stack.pixels) pixel = greyLevel(pixel + noise(random));
}

}  // namespace facescan::test
