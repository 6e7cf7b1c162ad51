// Finds the springs of a network that are longer or shorter than their limits. It is cheap enough to run after every
// step. Independent of the treatment of these springs.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "taut/mechanics/private/watch_kernel.h"
#include "taut/mechanics/spring_network.h"

namespace taut::mechanics {

// Lengths between which a spring may be [m].
struct LengthLimits {
    double least = 0;
    double most = std::numeric_limits<double>::infinity();
    bool isAny() const { return least > 0 || most < std::numeric_limits<double>::infinity(); }
};

template <class Real>
class SpringWatch {
  public:
    SpringWatch();

    // limits (springs of the network).
    void set(const SpringNetwork<Real>& network, std::span<const LengthLimits> limits);
    // Expects a spring that had limits before.
    void change(const SpringNetwork<Real>& network, int spring, const LengthLimits& limits);

    // Appends the numbers of the springs beyond their limits, ascending; x (3 · stride) [m]. Any number of threads
    // gives the same result.
    void find(const SpringNetwork<Real>& network, int stride, const Real* x, std::vector<int>& beyond) const;

  private:
    // The watched runs and single springs of a chunk.
    struct Part {
        std::vector<int> runs;
        int firstSingle = 0, lastSingle = 0;
    };
    bool isRunBeyond(const SpringNetwork<Real>& network, int run, int stride, const Real* x) const;
    bool isAnyBeyond(const SpringNetwork<Real>& network, const Part& part, int stride, const Real* x) const;
    const Real* leastFrom(std::size_t slot) const { return least_.empty() ? nullptr : least_.data() + slot; }

    bool (*run_)(const WatchRun<Real>&);
    bool (*list_)(const WatchList<Real>&);
    std::vector<Part> parts_;          // (chunks of the network)
    mutable std::vector<char> isHit_;  // (parts) scratch
    std::vector<Real> least_, most_;   // (places of the network) squares [m²]; least_ empty: none
};

extern template class SpringWatch<float>;
extern template class SpringWatch<double>;

}  // namespace taut::mechanics
