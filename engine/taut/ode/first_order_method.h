// A method that integrates y' = f(t, y) from t to t + h, for any y.
#pragma once

#include "taut/ode/system.h"

namespace taut::ode {

template <class Real>
class FirstOrderMethod {
  public:
    virtual ~FirstOrderMethod() = default;

    // Integrates y (system.size()) from t to t + h [s]. Allocates when the size changes.
    virtual void step(System<Real>& system, double t, double h, Real* y) = 0;

    // Of the derivative, a step.
    virtual int evaluations() const = 0;
};

}  // namespace taut::ode
