#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/image_motion.h"
#include "reconstruct/pixel_planes.h"
#include "reconstruct/stripe_images.h"

namespace facescan {

/// What a reconstruction makes of single frames and pairs, as they arrive: the stripe images, the
/// pixel planes, and the half images that the motion is estimated from. Whatever the order and the
/// moment in which frames are taken, the result is the same.
class FrameIntake {
public:
    /// Begins a scan. The frames' pixels are not read before take(); both are read until the scan
    /// is done.
    /// @param with_halves  whether the half images are wanted
    void begin(const FrameStackView& frames, const ScanDescription& scan, bool with_halves);

    /// A frame is there: does the work for which nothing more is needed.
    /// @param index  among the pattern frames, 0 … scan.pattern.frameCount() − 1
    void take(int index);

    /// All frames are there: turns those that have not been taken.
    void turnRest();

    /// Completes the planes and the half images.
    void addRest() { addPairs(images_.bits); }

    const StripeImages& images() const { return images_; }
    const PixelPlanes& planes() const { return planes_; }
    const HalfImages& halves() const { return halves_; }

private:
    bool taken(int index) const { return taken_ >> index & 1; }
    void turn(int index);
    /// Adds the pairs up to end − 1 that have not been added, all of them in one pass.
    void addPairs(int end);

    FrameStackView frames_;
    const ScanDescription* scan_ = nullptr;
    bool with_halves_ = false;
    std::uint32_t taken_ = 0;  ///< a bit for each frame
    int pairs_ = 0;            ///< that have been added
    StripeImages images_;
    std::vector<std::uint8_t> turned_;
    PixelPlanes planes_;
    HalfImages halves_;
};

}  // namespace facescan
