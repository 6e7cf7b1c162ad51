// The dashpots of an island, one after the other, for methods that split them off. Independent of methods.
//
// One dashpot between a and b at fixed positions damps u, the difference of their velocities along the unit vector n:
//   u' = -c (w_a + w_b) u.
// The implicit midpoint rule takes it over h in closed form. With y = ½ c h (w_a + w_b)
//   u(h) = (1 - y)/(1 + y) u(0),   impulse p = g u(0),   g = c h/(1 + y).
// The factor lies between -1 and 1 for every y >= 0. So no dashpot raises the kinetic energy, however stiff it is and
// however long the step: the sweep is stable without a condition. Both ends get the same impulse with opposite signs,
// along the line between them: momentum and angular momentum are kept to rounding.
//
// A sweep is a composition of such maps (Lie and Trotter splitting). By itself it is of order 1. Each map is its own
// adjoint, so the same sweep in the opposite order is the adjoint of the first one. before() and after() are such a
// pair, of half a step each, and a symmetric map between them makes the step symmetric, of order 2 (Strang 1968).
//
// Two limits remain, of accuracy:
// - One sweep carries an impulse along a row in the order of the sweep. Where y is large, chains of dashpots, each
//   joined to the next, are therefore solved as a whole by elimination (a tridiagonal system), between the two sweeps.
// - Beyond y = 1 the factor is negative: velocities turn round at every step instead of fading; where dashpots share
//   points, earlier. A step is kept to y <= ½ in each of the two sweeps (largestPairRate()).
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

    // Call it when springs or masses have changed.
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
    // The parts of ode::SplitSystem. between() damps the chains of strong dashpots, each chain as a whole. before()
    // damps all other dashpots in the order of the network, after() in the opposite order. Any number of threads gives
    // the same bits.
    void before(const SpringNetwork<Real>& network, const Points& points, double h);
    // For the same step, after before().
    void between(const Points& points);
    void after(const SpringNetwork<Real>& network, const Points& points);

    // The largest ½ c (w_a + w_b) [1/s] of the dashpots that between() may not damp. Times h/2 it is y of
    // dashpot_kernel.h; above y = ½ they would turn velocities round.
    double largestPairRate(const SpringNetwork<Real>& network, const Real* w);

  private:
    // Springs between points a, a + 1, …, a + count, with no other spring of the kind at these points: one run, or runs
    // end to end.
    struct Chain {
        int a = 0, count = 0;
        bool isAlone = true;  // else other such runs have points of it too
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
