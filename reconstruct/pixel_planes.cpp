#include "reconstruct/pixel_planes.h"

#include <algorithm>

#include "reconstruct/kernels/kernels.h"

namespace facescan {
namespace {

PixelRow rowOf(PixelPlanes& planes, int y) {
    const std::size_t i = planes.index(0, y);
    return {planes.stripe.data() + i, planes.brightness.data() + i, planes.low.data() + i,
            planes.modulation.data() + i};
}

}  // namespace

void computePixelPlanes(const StripeImages& images, PixelPlanes& planes) {
    const std::size_t pixels = std::size_t(images.width) * images.height;
    planes.width = images.width;
    planes.height = images.height;
    planes.stripe.resize(pixels);
    planes.brightness.resize(pixels);
    planes.low.resize(pixels);
    planes.modulation.resize(pixels);
    planes.saturated = 0;

    const Kernels& kernel = kernels();
    for (int y = 0; y < images.height; ++y) {
        const PixelRow row = rowOf(planes, y);
        kernel.startRow(images.width, row);
        PairRows pairs{.count = images.bits};
        for (int pair = 0; pair < images.bits; ++pair) {
            pairs.pattern[pair] = images.patternRow(pair, y);
            pairs.complement[pair] = images.complementRow(pair, y);
        }
        kernel.addPairs(pairs, images.width, row);
        planes.saturated += kernel.finishRow(images.width, row);
    }
}

}  // namespace facescan
