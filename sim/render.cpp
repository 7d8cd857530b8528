#include "sim/render.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "sim/lens.h"
#include "sim/parallel.h"
#include "sim/random.h"
#include "sim/ray_caster.h"
#include "sim/samples.h"

namespace facescan::sim {

namespace {

constexpr int kBandRows = 24;  // pixel rows that are rendered together

/// The brightness of each stripe, 0 … 1.
using Picture = std::vector<float>;

void requireBetween(const char* what, int value, int low, int high) {
    if (value >= low && value <= high) return;
    throw std::invalid_argument(std::string(what) + " " + std::to_string(value) + ": expected " +
                                std::to_string(low) + " to " + std::to_string(high));
}

void check(const Device& device, const ScanSettings& settings) {
    const Rect& image = device.image;
    requireBetween("bits", settings.bits, kMinBits, kMaxBits);
    requireBetween("samples a side", settings.samples_per_side, 1, 16);
    requireBetween("frames before", settings.frames_before, 0, 500);
    requireBetween("frames after", settings.frames_after, 0, 500);
    requireBetween("camera width", device.camera.width, 16, 8192);
    requireBetween("camera height", device.camera.height, 16, 8192);
    requireBetween("row padding", settings.row_padding, 0, 16384 - device.camera.width);
    requireBetween("image x", image.x, 0, device.camera.width - 16);
    requireBetween("image y", image.y, 0, device.camera.height - 16);
    requireBetween("image width", image.width, 16, device.camera.width - image.x);
    requireBetween("image height", image.height, 16, device.camera.height - image.y);
}

Picture uniformPicture(const Pattern& pattern, float brightness) {
    return Picture(pattern.stripes(), brightness);
}

/// What the projector shows in each frame.
std::vector<Picture> pictures(const Pattern& pattern, const ScanSettings& settings, float black) {
    const int frames = settings.frames_before + pattern.frameCount() + settings.frames_after;
    std::vector<Picture> shown(frames, uniformPicture(pattern, 1));
    for (int pair = 0; pair < pattern.bits; ++pair) {
        for (const bool complement : {false, true}) {
            Picture& picture = shown[settings.frames_before + pattern.frameIndex(pair, complement)];
            for (int stripe = 0; stripe < pattern.stripes(); ++stripe) {
                picture[stripe] = pattern.lit(pair, complement, stripe) ? 1.0f : black;
            }
        }
    }
    return shown;
}

/// Renders the frames band by band, each on one thread.
class Renderer {
public:
    Renderer(const RayCaster& caster, const Scene& scene, const Device& device,
             const ScanSettings& settings, SimulatedScan& scan)
        : caster_(caster),
          scene_(scene),
          device_(device),
          settings_(settings),
          scan_(scan),
          stripes_(scan.truth.pattern.stripes()),
          pictures_(pictures(scan.truth.pattern, settings, float(device.projector.black))),
          filter_(makeLensFilter(device.lens_sigma_px, settings.samples_per_side)) {}

    void renderBand(int first_row) const {
        const SampleWindow window{first_row, std::min(kBandRows, device_.camera.height - first_row),
                                  filter_.margin_px, settings_.samples_per_side};
        const int columns = window.sampleColumns(device_.camera.width);
        const std::vector<Eigen::Vector3f> viewing = viewingRays(device_.camera, window);
        const std::vector<Pose>& poses = scan_.truth.poses;
        SampleBand band;
        for (std::size_t frame = 0; frame < poses.size(); ++frame) {
            // A scanner at rest sees the same points in every frame.
            if (frame == 0 || !(poses[frame] == poses[frame - 1])) {
                band = trace(caster_, scene_, device_, stripes_, poses[frame], viewing, columns);
            }
            exposeFrame(int(frame), window, expected(window, band, pictures_[frame]));
            for (TruthMaps& maps : scan_.truth.maps) {
                if (maps.frame == int(frame)) countSamples(window, band, maps);
            }
            if (int(frame) == scan_.truth.first_frame) measureContrast(window, band);
        }
    }

private:
    /// The noise-free grey levels of a window's pixels.
    std::vector<float> expected(const SampleWindow& window, const SampleBand& band,
                                const Picture& picture) const {
        const int width = device_.camera.width;
        std::vector<float> radiance(band.samples.size());
        illuminate(band, picture, radiance);
        std::vector<float> grey(std::size_t(window.rows) * width);
        collect(filter_, radiance, width, window.rows, grey);
        for (float& g : grey) g = float(expectedGrey(device_.sensor, g));
        return grey;
    }

    void exposeFrame(int frame, const SampleWindow& window, const std::vector<float>& grey) const {
        FrameStack& frames = scan_.frames;
        for (int row = 0; row < window.rows; ++row) {
            const int y = window.first_row + row;
            std::uint8_t* target =
                frames.pixels.data() + (std::size_t(frame) * frames.height + y) * frames.row_stride;
            for (int x = 0; x < frames.width; ++x) {
                const std::uint64_t pixel = std::uint64_t(y) * frames.width + x;
                const std::uint64_t bits = hashed(settings_.seed, frame + 1, pixel);
                target[x] = expose(device_.sensor, grey[std::size_t(row) * frames.width + x], bits);
            }
        }
    }

    void countSamples(const SampleWindow& window, const SampleBand& band, TruthMaps& maps) const {
        const int s = window.per_side, width = device_.camera.width;
        const int columns = window.sampleColumns(width), margin = window.margin_px * s;
        for (int row = 0; row < window.rows; ++row) {
            for (int x = 0; x < width; ++x) {
                int hit = 0, lit = 0;
                for (int i = 0; i < s * s; ++i) {
                    const int sample_row = margin + row * s + i / s;
                    const int sample_column = margin + x * s + i % s;
                    const Sample& sample =
                        band.samples[std::size_t(sample_row) * columns + sample_column];
                    hit += sample.hit;
                    lit += sample.lit;
                }
                const std::size_t pixel = std::size_t(window.first_row + row) * width + x;
                maps.hit[pixel] = std::uint8_t(16 * hit / (s * s));
                maps.lit[pixel] = std::uint8_t(16 * lit / (s * s));
            }
        }
    }

    void measureContrast(const SampleWindow& window, const SampleBand& band) const {
        const Pattern& pattern = scan_.truth.pattern;
        const float black = float(device_.projector.black);
        const std::vector<float> lit = expected(window, band, uniformPicture(pattern, 1));
        const std::vector<float> dark = expected(window, band, uniformPicture(pattern, black));
        std::uint8_t* target =
            scan_.truth.contrast.data() + std::size_t(window.first_row) * device_.camera.width;
        for (std::size_t i = 0; i < lit.size(); ++i) {
            const float contrast = std::min(lit[i], 255.0f) - std::min(dark[i], 255.0f);
            target[i] = std::uint8_t(std::clamp(contrast + 0.5f, 0.0f, 255.0f));
        }
    }

    const RayCaster& caster_;
    const Scene& scene_;
    const Device& device_;
    const ScanSettings& settings_;
    SimulatedScan& scan_;
    int stripes_;
    std::vector<Picture> pictures_;
    LensFilter filter_;
};

double saturatedShare(const FrameStack& frames, const ScanDescription& description) {
    const Rect& image = description.image;
    std::size_t saturated = 0;
    for (int y = image.y; y < image.y + image.height; ++y) {
        for (int x = image.x; x < image.x + image.width; ++x) {
            bool any = false;
            for (int k = 0; k < description.pattern.frameCount() && !any; ++k) {
                const std::uint8_t* frame = frames.view().frame(description.first_frame + k);
                any = frame[std::size_t(y) * frames.row_stride + x] == 255;
            }
            saturated += any;
        }
    }
    return double(saturated) / (double(image.width) * image.height);
}

}  // namespace

SimulatedScan simulate(const Scene& scene, const Device& device, const ScanSettings& settings) {
    check(device, settings);
    const Pattern pattern{settings.bits, device.axis, settings.order};
    const Camera& camera = device.camera;
    const int frame_count = settings.frames_before + pattern.frameCount() + settings.frames_after;
    const int first = settings.frames_before;
    CalibrationFit fit = fitCalibration(device, pattern.stripes(), settings.calibration_degree);

    SimulatedScan scan;
    scan.description = {first, device.image, pattern, std::move(fit.calibration)};
    Truth& truth = scan.truth;
    truth.kind = scene.kind;
    truth.device = device;
    truth.pattern = pattern;
    truth.first_frame = first;
    truth.poses = posesOf(settings.motion, frame_count, first, pattern.frameCount(),
                          device.frame_interval_s, settings.seed);
    truth.still = settings.motion.isStill();
    truth.surface = scene.surface;
    truth.sphere = scene.sphere;
    truth.calibration_residual = fit.residual;
    truth.contrast.resize(std::size_t(camera.width) * camera.height);

    const RayCaster caster(scene);
    const auto mapsOf = [&](int frame) {
        return castTruthMaps(caster, scene, device, pattern.stripes(), truth.poses[frame], frame,
                             settings.threads);
    };
    truth.maps.push_back(mapsOf(first));
    if (!truth.still) truth.maps.push_back(mapsOf(first + pattern.frameCount() - 1));

    FrameStack& frames = scan.frames;
    frames.count = frame_count;
    frames.width = camera.width;
    frames.height = camera.height;
    frames.row_stride = camera.width + settings.row_padding;
    frames.pixels.resize(frames.view().frameBytes() * frame_count);

    const Renderer renderer(caster, scene, device, settings, scan);
    const int bands = (camera.height + kBandRows - 1) / kBandRows;
    forEach(bands, settings.threads, [&](int band) { renderer.renderBand(band * kBandRows); });
    truth.saturated_share = saturatedShare(frames, scan.description);
    return scan;
}

}  // namespace facescan::sim
