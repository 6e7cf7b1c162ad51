// Work counters of a method.
#pragma once

#include <cstdint>

namespace taut::ode {

// The cost of a run so far.
struct Work {
    std::int64_t evaluations = 0;  // of the acceleration, those to start and to synchronise included
    std::int64_t iterations = 0;   // of a solver: one product with the stiffness each
    std::int64_t unconverged = 0;  // solves that did not reach their tolerance

    Work& operator+=(const Work& other) {
        evaluations += other.evaluations;
        iterations += other.iterations;
        unconverged += other.unconverged;
        return *this;
    }
    Work& operator-=(const Work& other) {
        evaluations -= other.evaluations;
        iterations -= other.iterations;
        unconverged -= other.unconverged;
        return *this;
    }
};

}  // namespace taut::ode
