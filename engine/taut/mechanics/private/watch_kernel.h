// The inner loops that compare the lengths of springs with their limits. There is one copy for each instruction set,
// and all give the same answer.
#pragma once

namespace taut::mechanics {

// A run of springs: spring i joins points i and i + offset.
template <class Real>
struct WatchRun {
    int n;
    int offset;
    int stride;         // of x
    const Real* x;      // planes at the run's first point [m]
    const Real* least;  // (n) [m²] square of the least length; null: 0
    const Real* most;   // (n) [m²] square of the largest length
};

template <class Real>
struct WatchList {
    int n;
    int stride;
    const Real* x;  // planes from point 0
    const int* a;   // (n)
    const int* b;
    const Real* least;
    const Real* most;
};

}  // namespace taut::mechanics
