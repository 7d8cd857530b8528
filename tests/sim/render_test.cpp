#include "sim/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sim/artefacts.h"
#include "sim/small_scan.h"

namespace facescan::sim {
namespace {

constexpr double kAlbedo = 0.6;

Scene mattePlane(double distance_mm = 400) {
    return makePlane({.distance_mm = distance_mm, .material = {float(kAlbedo), 0}});
}

/// The grey level of the matte plane at 400 mm at a pixel, where `brightness` falls on it: ambient
/// light, and Lambert's law with the inverse square of the distance.
double planeGrey(const Device& device, int x, int y, double brightness) {
    const Eigen::Vector3d p = 400 * device.camera.ray({double(x), double(y)});
    const Eigen::Vector3d to_light = device.projector.centre() - p;
    const double falloff = device.projector.reference_mm / to_light.norm();
    const double direct = falloff * falloff * kAlbedo * -to_light.normalized().z();
    return expectedGrey(device.sensor, device.ambient * kAlbedo + direct * brightness);
}

/// The code at a pixel of a plane across the camera's axis.
double planeCode(const Device& device, double distance_mm, int x, int y, int stripes) {
    const Eigen::Vector3d p = distance_mm * device.camera.ray({double(x), double(y)});
    return stripes * locate(device.projector, p).along;
}

TEST(Simulate, DescribesTheScanThatItTook) {
    const Device device = smallQuietDevice();
    const SimulatedScan scan = simulate(mattePlane(), device,
                                        {.bits = 6,
                                         .order = FrameOrder::grouped,
                                         .frames_before = 1,
                                         .frames_after = 2,
                                         .row_padding = 8,
                                         .samples_per_side = 1});
    EXPECT_EQ(scan.frames.count, 15);
    EXPECT_EQ(scan.frames.width, 120);
    EXPECT_EQ(scan.frames.row_stride, 128);
    EXPECT_EQ(scan.frames.pixels.size(), 15u * 192 * 128);
    EXPECT_EQ(scan.description.first_frame, 1);
    EXPECT_EQ(scan.description.image, device.image);
    EXPECT_EQ(scan.description.pattern, (Pattern{6, CodeAxis::y, FrameOrder::grouped}));
    EXPECT_EQ(scan.description.calibration.range_min_mm, 300);
}

TEST(Simulate, StripesFarFromTheirEdgesHaveTheGreyOfTheReflectionModel) {
    Device device = smallQuietDevice();
    device.projector.blur = 0.1;
    device.projector.defocus = 0;
    const SimulatedScan scan = simulate(mattePlane(), device, {.bits = 4, .samples_per_side = 2});
    const Pattern& pattern = scan.description.pattern;
    int checked = 0;
    for (int y = 10; y < 180; ++y) {
        const double code = planeCode(device, 400, 60, y, 16);
        // Within a tenth of a stripe's middle, four standard deviations of the blur from its edges.
        if (std::abs(code - std::floor(code) - 0.5) > 0.1) continue;
        ++checked;
        for (int frame = 0; frame < 8; ++frame) {
            const bool lit = pattern.lit(frame / 2, frame % 2, std::uint32_t(code));
            EXPECT_NEAR(pixelAt(scan, frame, 60, y),
                        planeGrey(device, 60, y, lit ? 1 : device.projector.black), 0.6);
        }
    }
    EXPECT_GT(checked, 20);
}

TEST(Simulate, EdgesAreBlurredByTheIntegralOfTheProjectorsGaussian) {
    const Device device = [] {
        Device d = smallQuietDevice();
        d.lens_sigma_px = 0;
        return d;
    }();
    const SimulatedScan scan = simulate(mattePlane(), device, {.bits = 4, .samples_per_side = 4});
    // Pair 0 has one edge, between the stripes 7 and 8; the second half is lit.
    const double black = device.projector.black;
    for (int y = 60; y < 140; ++y) {
        const double code = planeCode(device, 400, 60, y, 16);
        const Eigen::Vector3d p = 400 * device.camera.ray({60, double(y)});
        const double sigma = blurAt(device.projector, locate(device.projector, p).depth);
        const double lit = 0.5 * std::erfc(-(code - 8) / sigma / std::sqrt(2.0));
        const double grey = planeGrey(device, 60, y, black + (1 - black) * lit);
        EXPECT_NEAR(pixelAt(scan, 0, 60, y), grey, 1.0) << y;
    }
}

TEST(Simulate, SignsNameTheStripeOfTheProjectorsEquation) {
    const Device device = smallQuietDevice();
    const SimulatedScan scan =
        simulate(mattePlane(430), device, {.bits = 5, .samples_per_side = 2});
    int checked = 0;
    for (int y = 4; y < 190; ++y) {
        for (int x = 2; x < 118; x += 5) {
            const double code = planeCode(device, 430, x, y, 32);
            if (std::abs(code - std::floor(code) - 0.5) > 0.3) continue;  // away from edges
            if (code < 1 || code > 31) continue;
            std::uint32_t word = 0;
            for (int pair = 0; pair < 5; ++pair) {
                word =
                    2 * word + (pixelAt(scan, 2 * pair, x, y) > pixelAt(scan, 2 * pair + 1, x, y));
            }
            EXPECT_EQ(grayStripe(word), std::uint32_t(code)) << x << ", " << y;
            ++checked;
        }
    }
    EXPECT_GT(checked, 1000);
}

TEST(Simulate, PatternAndComplementAddUpToTheSameInEveryPair) {
    const Device device = smallQuietDevice();
    const SimulatedScan scan = simulate(mattePlane(), device, {.bits = 6, .samples_per_side = 2});
    for (int y = 20; y < 170; ++y) {
        for (int x = 5; x < 115; x += 11) {
            const int sum = pixelAt(scan, 0, x, y) + pixelAt(scan, 1, x, y);
            for (int pair = 1; pair < 6; ++pair) {
                const int other = pixelAt(scan, 2 * pair, x, y) + pixelAt(scan, 2 * pair + 1, x, y);
                EXPECT_NEAR(other, sum, 2) << "each frame is rounded";
            }
        }
    }
}

TEST(Simulate, NoiseHasTheSensorsVariance) {
    Device device = smallQuietDevice();
    device.sensor.electrons_per_level = 12;
    device.sensor.read_noise_levels = 1.5;
    const int repeats = 100;
    const SimulatedScan scan = simulate(
        mattePlane(), device, {.bits = 4, .frames_before = repeats, .samples_per_side = 1});
    double measured = 0, model = 0;
    for (int y = 60; y < 120; y += 2) {
        for (int x = 10; x < 110; x += 2) {
            double sum = 0, squares = 0;
            for (int frame = 0; frame < repeats; ++frame) {
                const double grey = pixelAt(scan, frame, x, y);
                sum += grey;
                squares += grey * grey;
            }
            const double mean = sum / repeats;
            measured += (squares - sum * mean) / (repeats - 1);
            model += noiseVariance(device.sensor, mean) + 1.0 / 12;
        }
    }
    EXPECT_NEAR(measured / model, 1, 0.02);
}

TEST(Simulate, SameBytesForAnyNumberOfThreadsAndAnotherSeedOthers) {
    Device device = resized(standardDevice(), 120, 192);
    ScanSettings settings{.bits = 4, .samples_per_side = 2, .seed = 5, .threads = 1};
    settings.motion.tremor_mm = {0.3, 0.3, 0.3};
    settings.motion.tremor_deg = {0.1, 0.1, 0.1};
    const Scene scene = makeSphere({.edge_mm = 3});
    const SimulatedScan one = simulate(scene, device, settings);
    settings.threads = 3;
    const SimulatedScan three = simulate(scene, device, settings);
    EXPECT_EQ(one.frames.pixels, three.frames.pixels);
    EXPECT_EQ(one.description.calibration.coefficients, three.description.calibration.coefficients);
    EXPECT_EQ(one.truth.contrast, three.truth.contrast);
    EXPECT_EQ(one.truth.maps[1].lit, three.truth.maps[1].lit);
    settings.seed = 6;
    EXPECT_NE(one.frames.pixels, simulate(scene, device, settings).frames.pixels);
}

TEST(Simulate, MovingScannerSeesThePlaneFromWhereItIs) {
    const Device device = smallQuietDevice();
    ScanSettings settings{.bits = 4, .samples_per_side = 1};
    settings.motion.drift_mm = {0, 0, 3};
    const SimulatedScan scan = simulate(mattePlane(), device, settings);
    ASSERT_EQ(scan.truth.maps.size(), 2u);
    EXPECT_EQ(scan.truth.maps[1].frame, 7);
    const std::size_t i = pixelIndex(device, 60, 100);
    EXPECT_NEAR(scan.truth.maps[0].z[i], 400, 1e-4);
    EXPECT_NEAR(scan.truth.maps[1].z[i], 397, 1e-4);
    EXPECT_FALSE(scan.truth.still);
}

TEST(Simulate, SidewaysDeviceTakesTheSameFramesLyingDown) {
    const Device device = smallQuietDevice();
    const Scene scene = makePlane({.tilt_x_deg = 15, .tilt_y_deg = 5, .size_mm = 250});
    const ScanSettings settings{.bits = 5, .samples_per_side = 2};
    const SimulatedScan upright = simulate(scene, device, settings);
    const SimulatedScan lying = simulate(turnedSideways(scene), sideways(device), settings);
    ASSERT_EQ(lying.frames.width, 192);
    EXPECT_EQ(lying.description.pattern.axis, CodeAxis::x);
    std::size_t different = 0;
    for (int frame = 0; frame < 10; ++frame) {
        for (int y = 0; y < 192; ++y) {
            for (int x = 0; x < 120; ++x) {
                const int a = pixelAt(upright, frame, x, y);
                different += std::abs(a - pixelAt(lying, frame, 191 - y, x)) > 1;
            }
        }
    }
    EXPECT_LT(different, 10u * 192 * 120 / 1000) << "rays along the outline may fall either way";
}

TEST(Simulate, ContrastIsLitLessUnlit) {
    const Device device = smallQuietDevice();
    const SimulatedScan scan = simulate(mattePlane(), device, {.bits = 4, .samples_per_side = 1});
    const double expected =
        planeGrey(device, 60, 90, 1) - planeGrey(device, 60, 90, device.projector.black);
    EXPECT_NEAR(scan.truth.contrast[pixelIndex(device, 60, 90)], expected, 1);
}

TEST(Simulate, StripesBeyondTheShownOnesAreDark) {
    Device device = smallQuietDevice();
    device.projector.stripes_shown = 12;
    const SimulatedScan scan =
        simulate(mattePlane(), device, {.bits = 4, .frames_before = 1, .samples_per_side = 1});
    for (int y = 20; y < 170; ++y) {
        const double code = planeCode(device, 400, 60, y, 12);
        if (code > 1 && code < 11) {
            EXPECT_NEAR(pixelAt(scan, 0, 60, y), planeGrey(device, 60, y, 1), 1);
        }
    }
}

TEST(Simulate, RefusesSettingsThatTheFormatForbids) {
    const Scene scene = mattePlane();
    const Device device = smallQuietDevice();
    EXPECT_THROW(simulate(scene, device, {.bits = 3}), std::invalid_argument);
    EXPECT_THROW(simulate(scene, device, {.bits = 13}), std::invalid_argument);
    EXPECT_THROW(simulate(scene, device, {.calibration_degree = 0}), std::invalid_argument);
    EXPECT_THROW(simulate(scene, device, {.samples_per_side = 0}), std::invalid_argument);
    Device outside = device;
    outside.image = {0, 4, 120, 189};
    EXPECT_THROW(simulate(scene, outside), std::invalid_argument);
}

}  // namespace
}  // namespace facescan::sim
