// The interface of split methods to a system with strong damping.
#pragma once

namespace taut::ode {

// x'' = d(x, v) + r(t, x, v) - γ v, d linear in v and taking energy out.
template <class Real>
class SplitSystem {
  public:
    virtual ~SplitSystem() = default;
    // true: from now on accelerate() gives r only; false: both again.
    virtual void split(bool isSplit) = 0;
    // The effect of d on velocities in h [s] at fixed places, in three parts. The first applies some dashpots for h/2.
    // Then comes the kick of all other forces. The second part applies the other dashpots for h; they see the mean of
    // the velocities before the kick and after the kick and themselves. The third applies the dashpots of the first
    // part for h/2 in the opposite order. However strong the dashpots are, they add no energy.
    virtual void dampBefore(double h, const Real* x, Real* v) = 0;
    virtual void dampBetween(const Real* x, Real* v) = 0;
    // After the kick at t [s], before the dashpots: constraints distribute it over the tied points. Otherwise dashpots
    // would damp a motion that does not exist, and tied points would not rest at the balance of forces.
    virtual void shareOut(double /*t*/, Real* /*v*/) {}
    virtual void dampAfter(const Real* x, Real* v) = 0;
};

}  // namespace taut::ode
