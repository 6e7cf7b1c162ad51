// Where there is one thread: a task after the other.
#include "taut/core/private/parallel.h"

namespace taut::core {

void parallelFor(int count, const std::function<void(int)>& task) {
    for (int i = 0; i < count; ++i) task(i);
}

int threadCount() {
    return 1;
}

struct ThreadLimit::Impl {};

ThreadLimit::ThreadLimit(int) {}
ThreadLimit::~ThreadLimit() = default;

void ThreadLimit::run(const std::function<void()>& task) {
    task();
}

}  // namespace taut::core
