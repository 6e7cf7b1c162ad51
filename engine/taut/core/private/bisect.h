// Where a function of one number crosses zero, or a condition ends.
#pragma once

#include <utility>

namespace taut::core {

// The ends between which `isBelow`, true at low and false at high, turns false, after so many halvings.
template <class IsBelow>
std::pair<double, double> bisected(double low, double high, int halvings, const IsBelow& isBelow) {
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (isBelow(middle) ? low : high) = middle;
    }
    return {low, high};
}

// Where `f`, which falls from above zero to below it, crosses zero between low and high.
template <class F>
double rootOf(const F& f, double low, double high, int halvings) {
    const auto ends = bisected(low, high, halvings, [&](double x) { return f(x) > 0.0; });
    return 0.5 * (ends.first + ends.second);
}

}  // namespace taut::core
