// Follows long work, and stops it. Knows nothing of the work.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace taut::core {

struct Listener {
    const std::atomic<bool>* stop = nullptr;                                // set from outside
    std::function<void(double done, const std::string& doing)> progress{};  // done: 0 … 1; from one thread at a time

    bool isStopped() const { return stop != nullptr && *stop; }
    void report(double done, const std::string& doing) const {
        if (progress) progress(done, doing);
    }
};

}  // namespace taut::core
