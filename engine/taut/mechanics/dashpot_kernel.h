// The inner loops of dashpots, which act on the velocities of their ends one after the other. There is one copy for
// each instruction set, and every copy gives the same bits.
//
// A dashpot's impulse p is that of the mean of the velocities before and after it (the implicit midpoint rule):
//   p = c h (u + ½ Δu)·n,  v_a += w_a p n,  v_b -= w_b p n,  u = v_b - v_a.
// For a single dashpot Δu·n = -(w_a + w_b) p, so p = g u·n with g = c h/(1 + y), y = ½ c h (w_a + w_b). Consecutive
// dashpots of a run share points and are solved together.
#pragma once

namespace taut::mechanics {

template <class Real>
struct DashpotRun {
    int n;
    int offset;       // > 0: dashpot i joins points i and i + offset
    int stride;       // of x and v
    const Real* x;    // planes at the run's first point [m]
    Real* v;          // as x, changed [m/s]
    const Real* w;    // (points) at the run's first [1/kg]
    const Real* g;    // (n) [kg]
    bool isForwards;  // else from the last to the first
    bool isStiff;     // so that repeated substitution would take long
};

template <class Real>
struct DashpotList {
    int n;
    int stride;
    const Real* x;  // planes from point 0
    Real* v;
    const Real* w;
    const int* a;  // (n)
    const int* b;
    const Real* g;
    bool isForwards;
};

}  // namespace taut::mechanics
