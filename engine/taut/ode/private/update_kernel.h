// The inner loop of leap-frog. There is one copy for each instruction set, and every copy gives the same bits.
#pragma once

namespace taut::ode {

// One plane of a leap-frog update over n points:
//   v⁺ = keep v⁻ + gain a,  w = 1.5 v⁺ - 0.5 v⁻ (velocity at the end of the step, extrapolated),  x += h v⁺
// with keep = (1-b)/(1+b), gain = h/(1+b), b = γ h/2 for each point. Returns whether all |v⁺| are below the limit.
template <class Real>
using LeapfrogUpdate = bool (*)(int n, const Real* a, const Real* keep, const Real* gain, Real h, Real limit, Real* x,
                                Real* v, Real* w);

// That of the instruction set in use.
template <class Real>
LeapfrogUpdate<Real> leapfrogUpdate();

}  // namespace taut::ode
