#include "reconstruct/frame_intake.h"

namespace facescan {

void FrameIntake::begin(const FrameStackView& frames, const ScanDescription& scan,
                        bool with_halves) {
    frames_ = frames;
    scan_ = &scan;
    with_halves_ = with_halves;
    taken_ = 0;
    pairs_ = 0;
    images_ = stripeImages(frames, scan, turned_);
    beginPixelPlanes(images_, planes_);
    if (with_halves) beginHalfImages(images_, halves_);
}

void FrameIntake::take(int index) {
    turn(index);
    // Each pair brings the next bit of the codewords: they are added in their order.
    const Pattern& pattern = scan_->pattern;
    int complete = pairs_;
    while (complete < pattern.bits && taken(pattern.frameIndex(complete, false)) &&
           taken(pattern.frameIndex(complete, true))) {
        ++complete;
    }
    addPairs(complete);
}

void FrameIntake::addPairs(int end) {
    if (pairs_ >= end) return;
    for (int y = 0; y < images_.height; ++y) {
        facescan::addPairs(images_, pairs_, end, y, planes_);
        if (!with_halves_ || y % 2 == 0) continue;
        for (int pair = pairs_; pair < end; ++pair) addRow(images_, pair, y / 2, halves_);
    }
    pairs_ = end;
}

void FrameIntake::turn(int index) {
    if (taken(index)) return;
    turnFrame(frames_, *scan_, index, turned_);
    taken_ |= 1u << index;
}

void FrameIntake::turnRest() {
    for (int index = 0; index < scan_->pattern.frameCount(); ++index) {
        turn(index);
    }
}

}  // namespace facescan
