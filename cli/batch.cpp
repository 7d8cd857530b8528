#include "cli/batch.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace facescan {
namespace {

/// Brings outcomes back into order.
class OrderedDelivery {
public:
    explicit OrderedDelivery(const std::function<void(const ReplayOutcome&)>& deliver)
        : deliver_(deliver) {}

    void add(std::size_t job, ReplayOutcome outcome) {
        const std::lock_guard lock(mutex_);
        waiting_.emplace(job, std::move(outcome));
        for (auto next = waiting_.find(next_); next != waiting_.end();
             next = waiting_.find(++next_)) {
            deliver_(next->second);
            waiting_.erase(next);
        }
    }

private:
    const std::function<void(const ReplayOutcome&)>& deliver_;
    std::mutex mutex_;
    std::map<std::size_t, ReplayOutcome> waiting_;
    std::size_t next_ = 0;
};

}  // namespace

void runBatch(std::size_t count, int threads, const std::function<ReplayJobFunction()>& make_worker,
              const std::function<void(const ReplayOutcome&)>& deliver,
              const std::function<bool()>& stopped) {
    std::atomic<std::size_t> next_job = 0;
    OrderedDelivery delivery(deliver);
    const auto work = [&] {
        const ReplayJobFunction replay = make_worker();
        for (std::size_t job; !stopped() && (job = next_job++) < count;)
            delivery.add(job, replay(job));
    };

    std::vector<std::jthread> others;
    const std::size_t wanted = std::min(std::size_t(threads), count);
    try {
        while (others.size() + 1 < wanted) others.emplace_back(work);
    } catch (const std::system_error&) {
        // The system gives no more threads: those that run do the work.
    }
    work();
}

}  // namespace facescan
