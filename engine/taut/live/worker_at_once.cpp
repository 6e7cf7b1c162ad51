// Where there is one thread.
#include <exception>
#include <utility>

#include "taut/live/private/worker.h"

namespace taut::live {

struct Worker::Impl {
    std::exception_ptr failure;
};

Worker::Worker() : impl_(std::make_unique<Impl>()) {}
Worker::~Worker() = default;

void Worker::begin(std::function<void()> job) {
    try {
        job();
    } catch (...) {
        impl_->failure = std::current_exception();
    }
}

void Worker::wait() {
    if (impl_->failure) std::rethrow_exception(std::exchange(impl_->failure, nullptr));
}

}  // namespace taut::live
