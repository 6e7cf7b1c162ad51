// The dashpots of an island, one after the other: what a method that splits them off asks for.
#pragma once

#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/mechanics/dashpot_kernel.h"
#include "taut/mechanics/spring_network.h"

namespace taut::mechanics {

template <class Real>
class DashpotSweep {
  public:
    DashpotSweep();

    // To be called when springs or masses have changed.
    void forget() {
        h_ = 0;
        pairRate_ = -1;
    }

    // The points of a network: w (stride) [1/kg], x and v (3 · stride), v changed.
    struct Points {
        int stride;
        const Real* w;
        const Real* x;
        Real* v;
    };
    // The parts of ode::SplitSystem. Chains of strong dashpots, each joined to the next, are damped between, each as a
    // whole; all others before and after, in the order of the network and in the opposite one. The same bits for any
    // number of threads.
    void before(const SpringNetwork<Real>& network, const Points& points, double h);
    void between(const SpringNetwork<Real>& network, const Points& points, double h);
    void after(const SpringNetwork<Real>& network, const Points& points, double h);

    // The largest ½ c (w_a + w_b) [1/s] of dashpots that may not be damped between; times h/2 it is y of
    // dashpot_kernel.h, above ½ of which they would turn velocities round.
    double largestPairRate(const SpringNetwork<Real>& network, const Real* w);

  private:
    enum class Part { before, between, after };
    void prepare(const SpringNetwork<Real>& network, const Real* w, double h);
    void damp(const SpringNetwork<Real>& network, const Points& points, Part part);

    void (*run_)(const DashpotRun<Real>&);
    void (*list_)(const DashpotList<Real>&);
    double pairRate_ = -1;              // [1/s]; below 0: not known
    double h_ = 0;                      // [s] that the tables are for; 0: none
    std::vector<Real> g_;               // of the springs of all runs, then of the single ones
    std::vector<int> firstOf_;          // (runs) where theirs begin
    std::vector<bool> isStiff_;         // (runs)
    std::vector<bool> isBetween_;       // (runs)
    bool hasBetween_ = false;           // any
    core::AlignedArray<Real> earlier_;  // (3 · stride) velocities before the kick, then their mean with those after it
    std::size_t firstSingle_ = 0;
};

extern template class DashpotSweep<float>;
extern template class DashpotSweep<double>;

}  // namespace taut::mechanics
