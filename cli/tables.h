#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/replay_scan.h"
#include "cli/stage_timer.h"

// What people read on standard output.

namespace facescan {

/// A replayed scan: the milliseconds of each stage, counts, files and the verdict.
std::string replayTable(const ReplayOutcome& outcome);

/// The same in one line, for one of many.
std::string replayLine(const ReplayOutcome& outcome);

/// Milliseconds a stage, and in all.
std::string benchTable(const StageTimes& stages_ms, double total_ms);

/// Lines of a name and a text.
std::string propertyTable(std::span<const std::pair<std::string, std::string>> properties);

}  // namespace facescan
