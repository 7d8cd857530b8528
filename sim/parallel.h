#pragma once

#include <functional>

namespace facescan::sim {

/// Calls job(0) … job(count − 1), each once, on up to `threads` threads (0: one per core). Jobs run
/// in any order, so each must write only what is its own. The first exception is thrown on.
void forEach(int count, int threads, const std::function<void(int)>& job);

}  // namespace facescan::sim
