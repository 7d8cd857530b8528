#include "cli/batch.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace facescan {
namespace {

/// So many jobs a thread may be done before their turn comes. Enough that threads hardly ever wait.
constexpr std::size_t kAhead = 64;

/// Brings outcomes back into order.
class OrderedDelivery {
public:
    OrderedDelivery(const std::function<void(const ReplayOutcome&)>& deliver, std::size_t ahead)
        : deliver_(deliver), ahead_(ahead) {}

    /// Waits until the job is not too far ahead of the first that is not done.
    void awaitRoom(std::size_t job) {
        std::unique_lock lock(mutex_);
        room_.wait(lock, [&] { return job < next_ + ahead_; });
    }

    void add(std::size_t job, ReplayOutcome outcome) {
        const std::lock_guard lock(mutex_);
        waiting_.emplace(job, std::move(outcome));
        for (auto next = waiting_.find(next_); next != waiting_.end();
             next = waiting_.find(++next_)) {
            deliver_(next->second);
            waiting_.erase(next);
        }
        room_.notify_all();
    }

private:
    const std::function<void(const ReplayOutcome&)>& deliver_;
    const std::size_t ahead_;
    std::mutex mutex_;
    std::condition_variable room_;
    std::map<std::size_t, ReplayOutcome> waiting_;
    std::size_t next_ = 0;
};

}  // namespace

void runBatch(std::size_t count, int threads, const std::function<ReplayJobFunction()>& make_worker,
              const std::function<void(const ReplayOutcome&)>& deliver,
              const std::function<bool()>& stopped) {
    std::atomic<std::size_t> next_job = 0;
    const std::size_t wanted = std::min(std::size_t(threads), count);
    OrderedDelivery delivery(deliver, kAhead * wanted);
    const auto work = [&] {
        const ReplayJobFunction replay = make_worker();
        // A job once taken is done, whatever happens: those after it wait for its delivery.
        for (std::size_t job; !stopped() && (job = next_job++) < count;) {
            delivery.awaitRoom(job);
            delivery.add(job, replay(job));
        }
    };

    std::vector<std::jthread> others;
    try {
        while (others.size() + 1 < wanted) others.emplace_back(work);
    } catch (const std::system_error&) {
        // The system gives no more threads: those that run do the work.
    }
    work();
}

}  // namespace facescan
