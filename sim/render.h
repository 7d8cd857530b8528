#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/frame_stack.h"
#include "reconstruct/scan.h"
#include "sim/calibration_fit.h"
#include "sim/device.h"
#include "sim/motion.h"
#include "sim/scene.h"
#include "sim/truth_maps.h"

namespace facescan::sim {

/// How a scan is taken.
struct ScanSettings {
    int bits = 8;
    FrameOrder order = FrameOrder::interleaved;
    Motion motion{};
    int calibration_degree = 5;
    int frames_before = 0;  ///< further frames, all stripes lit, before the first pattern
    int frames_after = 0;   ///< … and behind the last
    int row_padding = 0;    ///< bytes behind each row

    int samples_per_side = 4;  ///< its square is the number of samples a pixel, 1 … 16 a side
    std::uint64_t seed = 1;    ///< of noise and tremor
    int threads = 0;           ///< 0: one per core; changes nothing in the result
};

/// What is known of a simulated scan beyond its frames.
struct Truth {
    std::string kind;  ///< the scene's
    Device device;
    Pattern pattern;
    int first_frame = 0;
    std::vector<Pose> poses;  ///< by frame: scanner to world; world is the scanner at first_frame
    bool still = true;
    Surface surface;               ///< in the world
    std::optional<Sphere> sphere;  ///< likewise
    std::vector<TruthMaps> maps;   ///< of the first pattern frame; if not still, of the last too
    std::vector<std::uint8_t> contrast;  ///< a pixel of the first map: lit less unlit, noise-free
    FitResidual calibration_residual;
    double saturated_share = 0;  ///< of the pixels of the image rectangle, in any pattern frame
};

struct SimulatedScan {
    FrameStack frames;
    ScanDescription description;
    Truth truth;
};

/// Scans a scene with a virtual device: projects each pattern, sees it through lens and sensor.
/// The same arguments give the same bytes. Throws std::invalid_argument where a setting is out of
/// range or the device's projector does not reach its measurement volume.
SimulatedScan simulate(const Scene& scene, const Device& device, const ScanSettings& settings = {});

}  // namespace facescan::sim
