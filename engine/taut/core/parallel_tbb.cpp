#include "taut/core/private/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace taut::core {
namespace {

constexpr int mostShares = 256;

}  // namespace

void parallelFor(int count, const std::function<void(int)>& task) {
    if (count == 1 || oneapi::tbb::this_task_arena::max_concurrency() == 1) {
        for (int i = 0; i < count; ++i) task(i);
        return;
    }
    // A share is no smaller than the cost of sharing.
    const int grain = std::max(1, count / mostShares);
    // Isolation keeps a waiting thread from picking up an unrelated task in the middle of this one.
    oneapi::tbb::this_task_arena::isolate([&] {
        oneapi::tbb::parallel_for(
            oneapi::tbb::blocked_range<int>(0, count, static_cast<std::size_t>(grain)),
            [&](const auto& range) {
                for (int i = range.begin(); i < range.end(); ++i) task(i);
            },
            oneapi::tbb::simple_partitioner());
    });
}

int threadCount() {
    using oneapi::tbb::global_control;
    return static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
}

struct ThreadLimit::Impl {
    explicit Impl(int threads)
        : control(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
          arena(threads) {}
    oneapi::tbb::global_control control;
    oneapi::tbb::task_arena arena;
};

ThreadLimit::ThreadLimit(int threads) : impl_(threads > 0 ? std::make_unique<Impl>(threads) : nullptr) {}
ThreadLimit::~ThreadLimit() = default;

void ThreadLimit::run(const std::function<void()>& task) {
    if (impl_)
        impl_->arena.execute(task);
    else
        task();
}

}  // namespace taut::core
