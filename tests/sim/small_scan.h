#pragma once

#include "sim/render.h"

namespace facescan::sim {

/// The default device with a sensor of 120 × 192 pixels, whose picture has no noise: grey levels
/// are exact but for rounding.
inline Device smallQuietDevice() {
    Device device = resized(standardDevice(), 120, 192);
    device.sensor.electrons_per_level = 0;
    device.sensor.read_noise_levels = 0;
    return device;
}

inline int pixelAt(const SimulatedScan& scan, int frame, int x, int y) {
    const FrameStackView view = scan.frames.view();
    return view.frame(frame)[y * view.row_stride + x];
}

inline std::size_t pixelIndex(const Device& device, int x, int y) {
    return std::size_t(y) * device.camera.width + x;
}

}  // namespace facescan::sim
