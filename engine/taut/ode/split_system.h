// What a method asks of a system whose strong damping it splits off.
#pragma once

namespace taut::ode {

// x'' = d(x, v) + r(t, x, v) - γ v, d linear in v and taking energy out.
template <class Real>
class SplitSystem {
  public:
    virtual ~SplitSystem() = default;
    // From now on accelerate() gives r alone; or both again.
    virtual void split(bool isSplit) = 0;
    // What d does to velocities in h [s] at fixed places, in three parts, the kick of all other forces between the
    // first and the second: h/2 of some dashpots, then h of the others, which see the mean of the velocities before and
    // after the kick and themselves, then h/2 of the first ones in the opposite order. However strong they are they add
    // no energy.
    virtual void dampBefore(double h, const Real* x, Real* v) = 0;
    virtual void dampBetween(const Real* x, Real* v) = 0;
    virtual void dampAfter(const Real* x, Real* v) = 0;
};

}  // namespace taut::ode
