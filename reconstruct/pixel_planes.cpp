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

void beginPixelPlanes(const StripeImages& images, PixelPlanes& planes) {
    const std::size_t pixels = std::size_t(images.width) * images.height;
    planes.width = images.width;
    planes.height = images.height;
    planes.stripe.resize(pixels);
    planes.brightness.resize(pixels);
    planes.low.resize(pixels);
    planes.modulation.resize(pixels);
    planes.saturated = 0;
}

void addPairs(const StripeImages& images, int first, int end, int y, PixelPlanes& planes) {
    const Kernels& kernel = kernels();
    const PixelRow row = rowOf(planes, y);
    PairRows pairs{.count = end - first};
    for (int n = 0; n < pairs.count; ++n) {
        pairs.pattern[n] = images.patternRow(first + n, y);
        pairs.complement[n] = images.complementRow(first + n, y);
    }
    if (first == 0) kernel.startRow(images.width, row);
    kernel.addPairs(pairs, images.width, row);
    if (end == images.bits) planes.saturated += kernel.finishRow(images.width, row);
}

}  // namespace facescan
