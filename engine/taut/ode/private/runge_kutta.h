// Explicit Runge-Kutta methods as tableaus. One loop runs all of them and knows none by name.
#pragma once

#include <memory>

#include "taut/ode/first_order_method.h"

namespace taut::ode {

// Methods in which every stage uses only the slope of the stage before:
//   k_s = f(t + c_s h, y + c_s h k_{s-1}),  y' = y + (h / divisor) Σ w_s k_s
// Weights are whole numbers, so that both precisions hold them exactly. If only the last is not 0, it is the divisor.
struct Tableau {
    static constexpr int most = 4;
    int stages;
    double c[most];
    int w[most];
    int divisor;
};

// Expects 1 … most stages and Σ w = divisor.
template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeRungeKutta(const Tableau& tableau);

}  // namespace taut::ode
