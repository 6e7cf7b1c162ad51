// Hands items that several threads finish in any order to one thread, in the order of their numbers. It knows nothing
// about the items.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace taut::pipeline {

template <class T>
class OrderedHandover {
  public:
    // At most so many items wait, besides the next one.
    explicit OrderedHandover(std::size_t room) : room_(static_cast<std::int64_t>(room)) {}

    // Numbers count from 0, each once. Waits until earlier items leave room. Returns false and drops the item if nobody
    // will ask for it any more.
    bool put(std::int64_t number, T item) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return number >= end_ || number <= next_ + room_; });
        if (number >= end_) return false;
        items_.emplace(number, std::move(item));
        changed_.notify_all();
        return true;
    }

    // Waits for the next item; none if there are no more.
    std::optional<T> take() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return next_ >= end_ || items_.contains(next_); });
        if (next_ >= end_) return std::nullopt;
        std::optional<T> item(std::move(items_.extract(next_++).mapped()));
        changed_.notify_all();
        return item;
    }

    // Items from that number on will not come. The queue still waits for the earlier ones.
    void endAt(std::int64_t number) {
        const std::lock_guard lock(mutex_);
        end_ = std::min(end_, number);
        changed_.notify_all();
    }

    // Nobody wants the items any more.
    void abandon() { endAt(0); }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::int64_t, T> items_;
    std::int64_t room_, next_ = 0, end_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace taut::pipeline
