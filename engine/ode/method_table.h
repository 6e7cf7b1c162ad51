// All methods by name. A new method is one file with a `make…` function, and one line here and in method_table.cpp.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "ode/method.h"

namespace taut::ode {

std::span<const MethodInfo> methods();

// nullptr when there is none of that name.
const MethodInfo* findMethod(std::string_view name);

// Expects a name from the table.
template <class Real>
std::unique_ptr<Method<Real>> makeMethod(std::string_view name);

// One for each file.
template <class Real>
std::unique_ptr<Method<Real>> makeExplicitEuler();
template <class Real>
std::unique_ptr<Method<Real>> makeLeapfrog();
template <class Real>
std::unique_ptr<Method<Real>> makeVelocityVerlet();

double explicitEulerLargestStep(const FastestMode& mode);
double leapfrogLargestStep(const FastestMode& mode);

}  // namespace taut::ode
