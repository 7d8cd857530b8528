#include "bench/analytic_scan.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "reconstruct/pinhole_scanner.h"
#include "reconstruct/striped_scene.h"

namespace facescan::bench {
namespace {

using Eigen::Vector3d;

constexpr int kAmbientLevel = 6;   // grey levels of the room's light
constexpr int kStepsAStripe = 64;  // of the projector coordinate
constexpr int kNoShine = -1;

/// The device at the size of its own pictures, 768 px high, and in proportion at others.
test::PinholeScanner scannerFor(int width, int height, int bits) {
    const double zoom = height / 768.0;
    return {.bits = bits,
            .width = width,
            .height = height,
            .focal_px = 1000 * zoom,
            .stripes_per_radian = 278 * zoom};
}

/// An ellipsoid 300 to 500 mm in front of the camera, its nose towards it.
test::Surface headSurface() {
    const Vector3d axes(80, 115, 75);
    const Vector3d centre(0, 5, 455);
    const test::Surface ball = test::sphereSurface(centre.cwiseQuotient(axes), 1);
    return [=](const Vector3d& ray) {
        const double across = ray.x() / 0.03;
        const double along = (ray.y() - 0.02) / 0.06;
        const double nose_mm = 18 * std::exp(-0.5 * (across * across + along * along));
        return ball(ray.cwiseQuotient(axes)) - nose_mm;
    };
}

/// The grey levels of a white surface by projector coordinate, in steps, in each frame of a scan.
FrameStack whiteLevels(const Pattern& pattern) {
    test::StripedScene ramp;
    ramp.code = [](double x, double) { return (x + 0.5) / kStepsAStripe; };
    ramp.camera_blur_px = 0.16 * kStepsAStripe;
    ramp.projector_blur_px = 0;
    ramp.white_level = 220;
    return test::drawScan(ramp, pattern, pattern.stripes() * kStepsAStripe, 1);
}

std::vector<std::int8_t> sensorNoise(std::size_t count) {
    std::mt19937 random(1);
    std::normal_distribution<float> level(0, 1);
    std::vector<std::int8_t> noise(count);
    for (std::int8_t& value : noise) value = std::int8_t(std::lround(level(random)));
    return noise;
}

/// What one image row shows, whatever is projected.
struct SceneRow {
    std::vector<int> step;         ///< projector coordinate; kNoShine where no light falls
    std::vector<int> reflectance;  ///< 0 … 256
};

/// 0 … 256: skin that is not even, and above the forehead strands of dark hair.
int reflectanceAlong(const Vector3d& ray) {
    const double skin = 190 + 50 * std::sin(80 * ray.x()) * std::sin(60 * ray.y());
    if (ray.y() > -0.12) return int(skin);
    return int(skin * (0.12 + 0.1 * std::sin(700 * ray.x() + 3 * std::sin(50 * ray.y()))));
}

void lookAlong(int y, const test::PinholeScanner& scanner, const test::Surface& surface,
               SceneRow& row) {
    const int steps = (1 << scanner.bits) * kStepsAStripe;
    for (int x = 0; x < scanner.width; ++x) {
        const Vector3d ray = scanner.ray(x, y);
        const double step = kStepsAStripe * scanner.codeOf(surface(ray) * ray);
        row.step[x] = step >= 0 && step < steps ? int(step) : kNoShine;
        row.reflectance[x] = reflectanceAlong(ray);
    }
}

}  // namespace

ScanBundle analyticScan(int width, int height, int bits) {
    const test::PinholeScanner scanner = scannerFor(width, height, bits);
    const test::Surface surface = headSurface();
    ScanBundle scan;
    scan.description = scanner.describe(FrameOrder::interleaved, 300, 520);
    scan.frames = test::blackFrames(scan.description.pattern, width, height);

    const FrameStack levels = whiteLevels(scan.description.pattern);
    const std::vector<std::int8_t> noise = sensorNoise(std::size_t(width) + 65536);
    std::mt19937 random(2);
    SceneRow row{std::vector<int>(width), std::vector<int>(width)};
    for (int y = 0; y < height; ++y) {
        lookAlong(y, scanner, surface, row);
        for (int frame = 0; frame < scan.frames.count; ++frame) {
            const std::uint8_t* white = levels.view().frame(frame);
            const std::int8_t* grain = noise.data() + random() % 65536;
            std::uint8_t* out = scan.frames.pixels.data() +
                                (std::size_t(frame) * height + y) * scan.frames.row_stride;
            for (int x = 0; x < width; ++x) {
                const int shine =
                    row.step[x] == kNoShine ? 0 : white[row.step[x]] * row.reflectance[x] / 256;
                out[x] = std::uint8_t(std::clamp(kAmbientLevel + shine + grain[x], 0, 255));
            }
        }
    }
    return scan;
}

}  // namespace facescan::bench
