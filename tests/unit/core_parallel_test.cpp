#include "taut/core/private/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace taut::core {
namespace {

TEST(ParallelFor, CallsEachIndexOnce) {
    std::vector<std::atomic<int>> calls(1000);
    parallelFor(1000, [&](int i) { ++calls[i]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST(ParallelFor, NestsAndTakesNothing) {
    std::atomic<int> calls = 0;
    parallelFor(0, [&](int) { ++calls; });
    EXPECT_EQ(calls, 0);
    parallelFor(8, [&](int) { parallelFor(8, [&](int) { ++calls; }); });
    EXPECT_EQ(calls, 64);
}

TEST(ParallelFor, HandsOnAnException) {
    EXPECT_THROW(parallelFor(
                     16,
                     [](int i) {
                         if (i == 7) throw std::runtime_error("seven");
                     }),
                 std::runtime_error);
}

TEST(ThreadLimit, SevenThreadsAreMoreThanTheMachineMayHave) {
    ThreadLimit limit(7);
    EXPECT_EQ(threadCount(), 7);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    limit.run([&] {
        // Each task waits for a third thread to come, long enough for one to be started on a busy machine.
        parallelFor(7, [&](int) {
            for (int waited = 0; waited < 2000; ++waited) {
                {
                    const std::lock_guard lock(mutex);
                    seen.insert(std::this_thread::get_id());
                    if (seen.size() >= 3) return;
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
        });
    });
    EXPECT_GE(seen.size(), 3U);
}

TEST(ThreadLimit, OneThreadRunsEverythingOnTheCaller) {
    const ThreadLimit limit(1);
    EXPECT_EQ(threadCount(), 1);
    const auto caller = std::this_thread::get_id();
    parallelFor(100, [&](int) { EXPECT_EQ(std::this_thread::get_id(), caller); });
}

}  // namespace
}  // namespace taut::core
