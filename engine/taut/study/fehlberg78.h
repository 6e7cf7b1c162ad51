// Fehlberg's Runge-Kutta method of order 8 with an error estimate of order 7, which controls its own steps: it computes
// the references of studies. It is not in the engine's table: it is too slow for ticks.
#pragma once

#include <memory>
#include <string_view>

#include "taut/ode/method_table.h"

namespace taut::study {

inline constexpr std::string_view fehlberg78 = "fehlberg-7(8)";

// The engine's own methods and this one. A step of it goes from t to t + h in as many inner steps as keep the estimate
// of their errors, RMS over the coordinates [m] and over velocities times the inner step [m], below
// MethodOptions::tolerance [m/s] times its length: their sum is about the tolerance times the time, and the motion may
// amplify it. Where forces have kinks the order is that of the kink and the steps are short. After 10000 inner steps it
// gives up control, and counts as not converged.
const std::shared_ptr<const ode::Methods>& referenceMethods();

}  // namespace taut::study
