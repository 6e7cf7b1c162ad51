#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "taut/core/error.h"
#include "taut/live/private/worker.h"

namespace taut::live {

struct Worker::Impl {
    std::mutex mutex;
    std::condition_variable changed;
    std::function<void()> job;  // null: there is none
    bool isOver = false;
    std::exception_ptr failure;
    std::jthread thread{[this] { loop(); }};

    ~Impl() {
        const std::lock_guard lock(mutex);
        isOver = true;
        changed.notify_all();
    }

    void loop() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [&] { return isOver || job; });
            if (isOver) return;
            lock.unlock();
            try {
                job();
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            job = nullptr;
            changed.notify_all();
        }
    }
};

Worker::Worker() : impl_(std::make_unique<Impl>()) {}
Worker::~Worker() = default;

void Worker::begin(std::function<void()> job) {
    const std::lock_guard lock(impl_->mutex);
    TAUT_EXPECTS(!impl_->job);
    impl_->job = std::move(job);
    impl_->changed.notify_all();
}

void Worker::wait() {
    std::unique_lock lock(impl_->mutex);
    impl_->changed.wait(lock, [&] { return !impl_->job; });
    if (impl_->failure) std::rethrow_exception(std::exchange(impl_->failure, nullptr));
}

}  // namespace taut::live
