// The midpoint method: y' = y + h f(t + h/2, y + (h/2) f(t, y)). Order 2. Undamped motion grows by 1 + z⁴/8 a step.
#include "taut/ode/method_table.h"
#include "taut/ode/runge_kutta.h"

namespace taut::ode {

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeMidpoint() {
    return makeRungeKutta<Real>({2, {0.0, 0.5}, {0, 1}, 1});
}
template std::unique_ptr<FirstOrderMethod<float>> makeMidpoint();
template std::unique_ptr<FirstOrderMethod<double>> makeMidpoint();

}  // namespace taut::ode
