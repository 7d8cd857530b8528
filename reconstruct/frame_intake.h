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
    void begin(const FrameStackView& frames, const ScanDescription& scan);

    /// A frame is there: does the work for which nothing more is needed.
    /// @param index  among the pattern frames, 0 … scan.pattern.frameCount() − 1
    void take(int index);

    /// All frames are there: turns those that have not been taken.
    void turnRest();

    /// What only needs all frames: for the pairs that were not complete before.
    void completePlanes() { addPairs(images_, images_.bits, planes_); }
    void completeHalves() { addPairs(images_, images_.bits, halves_); }

    const StripeImages& images() const { return images_; }
    const PixelPlanes& planes() const { return planes_; }
    const HalfImages& halves() const { return halves_; }

private:
    bool taken(int index) const { return taken_ >> index & 1; }

    FrameStackView frames_;
    const ScanDescription* scan_ = nullptr;
    std::uint32_t taken_ = 0;  ///< a bit for each frame
    StripeImages images_;
    std::vector<std::uint8_t> turned_;
    PixelPlanes planes_;
    HalfImages halves_;
};

}  // namespace facescan
