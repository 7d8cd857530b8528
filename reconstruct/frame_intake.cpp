#include "reconstruct/frame_intake.h"

namespace facescan {

void FrameIntake::begin(const FrameStackView& frames, const ScanDescription& scan) {
    frames_ = frames;
    scan_ = &scan;
    taken_ = 0;
    images_ = stripeImages(frames, scan, turned_);
    beginPixelPlanes(images_, planes_);
    beginHalfImages(images_, halves_);
}

void FrameIntake::take(int index) {
    if (taken(index)) return;
    turnFrame(frames_, *scan_, index, turned_);
    taken_ |= 1u << index;
    // Each pair brings the next bit of the codewords: they are added in their order.
    const Pattern& pattern = scan_->pattern;
    int complete = planes_.pairs;
    while (complete < pattern.bits && taken(pattern.frameIndex(complete, false)) &&
           taken(pattern.frameIndex(complete, true))) {
        ++complete;
    }
    addPairs(images_, complete, planes_);
    addPairs(images_, complete, halves_);
}

void FrameIntake::turnRest() {
    for (int index = 0; index < scan_->pattern.frameCount(); ++index) {
        if (taken(index)) continue;
        turnFrame(frames_, *scan_, index, turned_);
        taken_ |= 1u << index;
    }
}

}  // namespace facescan
