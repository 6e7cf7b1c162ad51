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
        chains_.clear();
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
    // Of the same step, after before().
    void between(const Points& points);
    void after(const SpringNetwork<Real>& network, const Points& points);

    // The largest ½ c (w_a + w_b) [1/s] of dashpots that may not be damped between; times h/2 it is y of
    // dashpot_kernel.h, above ½ of which they would turn velocities round.
    double largestPairRate(const SpringNetwork<Real>& network, const Real* w);

  private:
    // Springs between points a, a + 1, …, a + count that share no other spring of the kind: one run, or runs end to
    // end.
    struct Chain {
        int a = 0, count = 0;
        bool isAlone = true;  // else its points are in other such runs, too
        bool isBetween = false;
        std::size_t firstG = 0;  // into chainG_
        std::vector<std::size_t> runs;
    };
    void findChains(const SpringNetwork<Real>& network);
    void dampChain(const Chain& chain, const Points& points);
    enum class Part { before, after };
    void prepare(const SpringNetwork<Real>& network, const Real* w, double h);
    void damp(const SpringNetwork<Real>& network, const Points& points, Part part);

    void (*run_)(const DashpotRun<Real>&);
    void (*list_)(const DashpotList<Real>&);
    std::vector<Chain> chains_;                  // of the network, once found
    std::vector<double> p_, up_, down_, pivot_;  // scratch
    double pairRate_ = -1;                       // [1/s]; below 0: not known
    double h_ = 0;                               // [s] that the tables are for; 0: none
    std::vector<Real> g_;                        // of the springs of all runs, then of the single ones
    std::vector<int> firstOf_;                   // (runs) where theirs begin
    std::vector<bool> isStiff_;                  // (runs)
    std::vector<bool> isBetween_;                // (runs)
    std::vector<Real> chainG_;                   // of the springs of the chains that are damped between
    bool hasBetween_ = false;                    // any
    core::AlignedArray<Real> earlier_;  // (3 · stride) velocities before the kick, then their mean with those after it
    std::size_t firstSingle_ = 0;
};

extern template class DashpotSweep<float>;
extern template class DashpotSweep<double>;

}  // namespace taut::mechanics
