#pragma once

#include "reconstruct/pixel_planes.h"
#include "reconstruct/stripe_images.h"

namespace facescan::test {

/// The stripe images of a scan whose frames are all there.
inline StripeImages allStripeImages(const FrameStackView& frames, const ScanDescription& scan,
                                    std::vector<std::uint8_t>& buffer) {
    const StripeImages images = stripeImages(frames, scan, buffer);
    for (int index = 0; index < scan.pattern.frameCount(); ++index) {
        turnFrame(frames, scan, index, buffer);
    }
    return images;
}

/// The planes of all pairs at once.
inline void fillPlanes(const StripeImages& images, PixelPlanes& planes) {
    beginPixelPlanes(images, planes);
    for (int y = 0; y < images.height; ++y) addPairs(images, 0, images.bits, y, planes);
}

}  // namespace facescan::test
