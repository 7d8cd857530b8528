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
    planes.pairs = 0;
}

void addPairs(const StripeImages& images, int end, PixelPlanes& planes) {
    if (planes.pairs >= end) return;
    const Kernels& kernel = kernels();
    PairRows pairs{.count = end - planes.pairs};
    for (int y = 0; y < images.height; ++y) {
        const PixelRow row = rowOf(planes, y);
        for (int n = 0; n < pairs.count; ++n) {
            pairs.pattern[n] = images.patternRow(planes.pairs + n, y);
            pairs.complement[n] = images.complementRow(planes.pairs + n, y);
        }
        if (planes.pairs == 0) kernel.startRow(images.width, row);
        kernel.addPairs(pairs, images.width, row);
        if (end == images.bits) planes.saturated += kernel.finishRow(images.width, row);
    }
    planes.pairs = end;
}

}  // namespace facescan
