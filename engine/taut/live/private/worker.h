// A job at a time, done while its owner goes on; where there is one thread, before its owner goes on.
#pragma once

#include <functional>
#include <memory>

namespace taut::live {

class Worker {
  public:
    Worker();
    ~Worker();  // when the job is done

    // Expects that wait() was called for the job before.
    void begin(std::function<void()> job);

    // Returns when the job is done, or rethrows its exception. Without a job it returns at once.
    void wait();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::live
