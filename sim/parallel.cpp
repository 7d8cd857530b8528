#include "sim/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace facescan::sim {

void forEach(int count, int threads, const std::function<void(int)>& job) {
    std::atomic<int> next = 0;
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const auto work = [&] {
        try {
            for (int i; (i = next.fetch_add(1)) < count;) job(i);
        } catch (...) {
            next = count;
            const std::scoped_lock lock(failure_mutex);
            if (!failure) failure = std::current_exception();
        }
    };
    const int wanted = threads > 0 ? threads : int(std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> helpers;
        for (int i = 1; i < std::min(wanted, count); ++i) helpers.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace facescan::sim
