#include "cli/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace facescan {
namespace {

ReplayOutcome outcomeOf(std::size_t job) {
    ReplayOutcome outcome;
    outcome.bits = int(job);
    return outcome;
}

bool never() {
    return false;
}

TEST(Batch, DeliversEachJobOnceAndInOrder) {
    for (const int threads : {1, 2, 7}) {
        std::vector<int> delivered;
        runBatch(
            1000, threads,
            [] {
                return [](std::size_t job) {
                    if (job % 50 == 0) std::this_thread::yield();
                    return outcomeOf(job);
                };
            },
            [&](const ReplayOutcome& outcome) { delivered.push_back(outcome.bits); }, never);
        ASSERT_EQ(delivered.size(), 1000u);
        EXPECT_TRUE(std::ranges::is_sorted(delivered));
    }
}

TEST(Batch, HoldsABoundedNumberOfOutcomesWhereOneIsSlow) {
    // Job 0 takes until the others wait for it.
    std::atomic<std::size_t> begun = 0;
    std::size_t before_the_slow_one_ended = 0;
    const auto replay = [&](std::size_t job) {
        ++begun;
        for (std::size_t seen = 0; job == 0 && (seen < 2 || seen != begun);) {
            seen = begun;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        if (job == 0) before_the_slow_one_ended = begun;
        return outcomeOf(job);
    };
    int delivered = 0;
    runBatch(
        10'000, 2, [&] { return replay; }, [&](const ReplayOutcome&) { ++delivered; }, never);
    EXPECT_EQ(delivered, 10'000);
    EXPECT_LT(before_the_slow_one_ended, 1000u);
}

TEST(Batch, StopsBetweenJobs) {
    std::atomic<int> done = 0;
    int delivered = 0;
    runBatch(
        1000, 3,
        [&] {
            return [&](std::size_t job) {
                ++done;
                return outcomeOf(job);
            };
        },
        [&](const ReplayOutcome&) { ++delivered; }, [&] { return done >= 10; });
    EXPECT_EQ(delivered, done);
    EXPECT_LE(done, 13);
}

}  // namespace
}  // namespace facescan
