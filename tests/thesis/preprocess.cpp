#include "thesis/preprocess.h"

namespace facescan::thesis {

namespace {

Image cropped(const FrameStackView& frames, int index, const Rect& rect) {
    Image image(rect.width, rect.height);
    for (int y = 0; y < rect.height; ++y) {
        const std::uint8_t* row =
            frames.frame(index) + std::size_t(rect.y + y) * frames.row_stride + rect.x;
        for (int x = 0; x < rect.width; ++x) image.at(x, y) = row[x] / 255.0;
    }
    return image;
}

Image transposed(const Image& image) {
    Image turned(image.height, image.width);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) turned.at(y, x) = image.at(x, y);
    }
    return turned;
}

}  // namespace

std::vector<FramePair> preprocess(const FrameStackView& frames, const ScanDescription& scan) {
    const auto frame = [&](int pair, bool complement) {
        const int index = scan.first_frame + scan.pattern.frameIndex(pair, complement);
        return cropped(frames, index, scan.image);
    };
    std::vector<FramePair> pairs;
    pairs.reserve(scan.pattern.bits);
    for (int pair = 0; pair < scan.pattern.bits; ++pair) {
        pairs.push_back({frame(pair, false), frame(pair, true)});
    }
    return pairs;
}

void layStripesAlongRows(CodeAxis axis, std::vector<FramePair>& pairs) {
    if (axis == CodeAxis::y) return;
    for (FramePair& pair : pairs) pair = {transposed(pair.pattern), transposed(pair.complement)};
}

PlanePoint placeInFrame(const ScanDescription& scan, PlanePoint place) {
    if (scan.pattern.axis == CodeAxis::x) place = {place.y, place.x};
    return {place.x + scan.image.x, place.y + scan.image.y};
}

}  // namespace facescan::thesis
