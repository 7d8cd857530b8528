#pragma once

#include <cstddef>
#include <functional>

#include "cli/replay_scan.h"

namespace facescan {

/// Replays one job of a batch, with memory of its own.
using ReplayJobFunction = std::function<ReplayOutcome(std::size_t job)>;

/// Calls the functions that `make_worker` returns, one for each thread, for the jobs 0 … count − 1,
/// and `deliver` with their outcomes in this order, one at a time. The caller's thread is one of
/// the `threads`.
///
/// @param stopped  asked before each job; true leaves out those that have not begun
void runBatch(std::size_t count, int threads, const std::function<ReplayJobFunction()>& make_worker,
              const std::function<void(const ReplayOutcome&)>& deliver,
              const std::function<bool()>& stopped);

}  // namespace facescan
