// Lets a method for y' = f(t, y) integrate second-order systems: it sees positions and velocities as one array.
#pragma once

#include <memory>

#include "taut/ode/first_order_method.h"
#include "taut/ode/method.h"

namespace taut::ode {

// Expects a method. The state keeps the velocities at t.
template <class Real>
std::unique_ptr<Method<Real>> makeStacked(std::unique_ptr<FirstOrderMethod<Real>> method);

}  // namespace taut::ode
