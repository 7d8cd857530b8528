#pragma once

#include <array>
#include <chrono>

#include "reconstruct/stage.h"

namespace facescan {

/// Measures passages of time, each from the end of the one before.
class Stopwatch {
public:
    double lapMilliseconds() {
        const Clock::time_point now = Clock::now();
        const std::chrono::duration<double, std::milli> lap = now - last_;
        last_ = now;
        return lap.count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

using StageTimes = std::array<double, kStageCount>;  ///< milliseconds, by stage

/// Takes the time of each stage of one reconstruction, which begins when this is made.
class StageTimer : public StageObserver {
public:
    void finished(Stage stage) override {
        times_[std::size_t(stage)] += stopwatch_.lapMilliseconds();
    }

    const StageTimes& times() const { return times_; }

private:
    Stopwatch stopwatch_;
    StageTimes times_{};
};

}  // namespace facescan
