#pragma once

#include "reconstruct/image.h"
#include "reconstruct/pattern.h"
#include "sim/camera.h"
#include "sim/projector.h"
#include "sim/sensor.h"

namespace facescan::sim {

/// A whole scanner. The defaults are a hand-held device for faces at 300–520 mm, its projector
/// 120 mm above the camera.
struct Device {
    Camera camera;
    Projector projector;
    Sensor sensor;
    double lens_sigma_px = 0.35;  ///< Gaussian blur of the camera's lens
    double ambient = 0.06;        ///< even light on the scene, the projector's at reference_mm is 1
    CodeAxis axis = CodeAxis::y;  ///< the image axis along which the code changes
    Rect image = {0, 14, 480, 754};  ///< the rectangle to be reconstructed
    double range_min_mm = 300;
    double range_max_mm = 520;
    double frame_interval_s = 1 / 60.0;
};

/// The default device.
Device standardDevice();

/// The same with its projector mounted upside down: the code falls along the image axis.
Device withProjectorUpsideDown(Device device);

/// The same with camera and projector turned by a quarter about the camera's axis: the code runs
/// along the image's x. A scene turned by turnedSideways() looks the same to it, lying down.
Device sideways(Device device);

/// The same field of view on a sensor of another size.
Device resized(Device device, int width, int height);

}  // namespace facescan::sim
