#pragma once

#include <cstdint>
#include <functional>

#include "reconstruct/frame_stack.h"
#include "reconstruct/pattern.h"
#include "reconstruct/scan.h"

namespace facescan::test {

/// A function of the place in the image, px.
using Field = std::function<double(double x, double y)>;

/// A scene under striped light whose picture is known in closed form.
///
/// A stripe edge blurred by Gaussian point spreads of projector and camera is an error function of
/// the projector coordinate. Where the reflectance is exp(k · p), the camera's point spread of
/// variance σ² moves that edge function by −σ² k, and scales it; for a code and a ln(reflectance)
/// that are linear in the place this is exact.
struct StripedScene {
    /// The projector coordinate, stripes; not a number where the projector's light does not reach.
    Field code;
    Field log_reflectance = [](double, double) { return 0.0; };
    double camera_blur_px = 0.45;     ///< standard deviation, lens and pixel together
    double projector_blur_px = 0.35;  ///< the same, as the camera sees it
    double white_level = 200;         ///< grey levels of a lit stripe at reflectance 1
    double dark_share = 0.05;         ///< the light of a dark stripe against that of a lit one
    double ambient_level = 0;         ///< grey levels of the room's light at reflectance 1
};

/// A stack of black frames for a pattern, rows without padding.
FrameStack blackFrames(const Pattern& pattern, int width, int height);

/// Draws one frame of a scan: `pair` with its stripes lit, or the complement.
void drawFrame(const StripedScene& scene, const Pattern& pattern, int pair, bool complement,
               FrameStack& stack);

/// All frames of a scan of a scene that stands still.
FrameStack drawScan(const StripedScene& scene, const Pattern& pattern, int width, int height);

/// A description for frames that are reconstructed whole. The calibration stays empty.
ScanDescription wholeFrames(const FrameStack& stack, const Pattern& pattern);

/// Adds Gaussian noise to all pixels.
void addNoise(double grey_levels, std::uint32_t seed, FrameStack& stack);

}  // namespace facescan::test
