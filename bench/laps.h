#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "reconstruct/stage.h"

namespace facescan::bench {

/// Takes the time of each step of something that is done many times: processor time of the thread,
/// which other programs on the machine hardly disturb.
class Laps {
public:
    explicit Laps(std::vector<std::string> steps);

    /// All steps begin anew.
    void begin();
    /// What has passed since the last call belongs to `step`; one in several pieces says so at
    /// each.
    void finished(std::size_t step);
    /// The last step is done.
    void end();

    /// Adds the median seconds of each step to the results, as counters `stage:<number>:<name>`,
    /// and of the whole under the name `total`.
    void report(benchmark::State& state) const;

private:
    std::vector<std::string> steps_;
    std::vector<std::vector<double>> seconds_;  ///< of each step, of all times
    std::vector<double> totals_;
    double begin_ = 0;
    double last_ = 0;
};

/// The same for the stages of a reconstruction.
class StageClock : public StageObserver {
public:
    StageClock();
    void begin() { laps_.begin(); }
    void finished(Stage stage) override { laps_.finished(std::size_t(stage)); }
    void end() { laps_.end(); }
    void report(benchmark::State& state) const { laps_.report(state); }

private:
    Laps laps_;
};

}  // namespace facescan::bench
