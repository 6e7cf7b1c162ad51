#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "taut/pipeline/bounded_queue.h"

namespace taut::pipeline {
namespace {

TEST(BoundedQueue, GivesItemsInOrderAndNothingWhenClosedAndEmpty) {
    BoundedQueue<int> queue(3);
    EXPECT_TRUE(queue.push(1));
    EXPECT_TRUE(queue.push(2));
    queue.close();
    EXPECT_FALSE(queue.push(3));
    EXPECT_EQ(queue.pop(), 1);
    EXPECT_EQ(queue.pop(), 2);
    EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, NeverHoldsMoreThanItsCapacity) {
    BoundedQueue<int> queue(2);
    std::atomic<int> inside = 0;
    std::atomic<int> most = 0;
    std::jthread producer([&] {
        for (int i = 0; i < 1000; ++i) {
            queue.push(i);
            most = std::max(most.load(), ++inside);
        }
        queue.close();
    });
    int expected = 0;
    while (const auto item = queue.pop()) {
        --inside;
        EXPECT_EQ(*item, expected++);
    }
    EXPECT_EQ(expected, 1000);
    // Two in the queue and one already taken but not yet counted down.
    EXPECT_LE(most, 3);
}

TEST(BoundedQueue, AbandoningWakesWhoWaitsForRoomAndWhoWaitsForItems) {
    BoundedQueue<int> full(1);
    full.push(1);
    BoundedQueue<int> empty(1);
    bool pushed = true;
    std::optional<int> got = 0;
    std::jthread pusher([&] { pushed = full.push(2); });
    std::jthread popper([&] { got = empty.pop(); });
    full.abandon();
    empty.abandon();
    pusher.join();
    popper.join();
    EXPECT_FALSE(pushed);
    EXPECT_EQ(got, std::nullopt);
    EXPECT_EQ(full.pop(), std::nullopt);
}

}  // namespace
}  // namespace taut::pipeline
