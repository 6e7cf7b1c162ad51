// Parallel loops. The result of a task may depend on its index only, never on the number of threads.
#pragma once

#include <functional>
#include <memory>

namespace taut::core {

// Calls task(0) … task(count - 1), each once, in any order and on any thread; returns when all are done. Rethrows an
// exception of a task; then some may not have run.
void parallelFor(int count, const std::function<void(int)>& task);

// The same, but tasks that are `inTurn` run one after another, ascending, in parallel with the others.
void parallelFor(int count, const std::function<bool(int)>& inTurn, const std::function<void(int)>& task);

// Calls each(0) … each(count - 1), `atOnce` of them in one task: for short calls.
template <class Each>
void parallelFor(int count, int atOnce, const Each& each) {
    parallelFor((count + atOnce - 1) / atOnce,
                [&](int task) {
                    const int first = task * atOnce, last = first + atOnce < count ? first + atOnce : count;
                    for (int i = first; i < last; ++i) each(i);
                });
}

// [s] Spent so far by all threads of the process.
double processorSeconds();

// How many threads parallelFor uses.
int threadCount();

// Sets how many: at most that many in the whole process while a limit lives, and that many, even
// if the machine has fewer processors, within its run(). 0 leaves it to the machine.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);  // expects >= 0
    ~ThreadLimit();

    // Calls the task with that many threads at its disposal, and returns when it is done.
    void run(const std::function<void()>& task);

    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::core
