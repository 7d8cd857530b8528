#include "bench/laps.h"

#include <algorithm>
#include <ctime>

namespace facescan::bench {
namespace {

double threadSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Results are kept by name: numbers hold the steps in their order.
std::string counterName(std::size_t number, const std::string& step) {
    return "stage:" + std::to_string(number + 10) + ':' + step;
}

std::vector<std::string> stageNames() {
    std::vector<std::string> names(kStageCount);
    for (int stage = 0; stage < kStageCount; ++stage)
        names[std::size_t(stage)] = name(Stage(stage));
    return names;
}

}  // namespace

Laps::Laps(std::vector<std::string> steps) : steps_(std::move(steps)), seconds_(steps_.size()) {}

void Laps::begin() {
    for (std::vector<double>& times : seconds_) times.push_back(0);
    begin_ = last_ = threadSeconds();
}

void Laps::finished(std::size_t step) {
    const double now = threadSeconds();
    seconds_[step].back() += now - last_;
    last_ = now;
}

void Laps::end() {
    totals_.push_back(last_ - begin_);
}

void Laps::report(benchmark::State& state) const {
    for (std::size_t step = 0; step < steps_.size(); ++step)
        state.counters[counterName(step, steps_[step])] = median(seconds_[step]);
    state.counters[counterName(steps_.size(), "total")] = median(totals_);
}

StageClock::StageClock() : laps_(stageNames()) {}

}  // namespace facescan::bench
