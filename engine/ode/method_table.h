// All methods by name. A new method is one file with a `make…` function, and one line here and in method_table.cpp.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "taut/ode/first_order_method.h"
#include "taut/ode/method.h"

namespace taut::ode {

std::span<const MethodInfo> methods();

// nullptr when there is none of that name.
const MethodInfo* findMethod(std::string_view name);

// For second-order systems. Expects a name from the table.
template <class Real>
std::unique_ptr<Method<Real>> makeMethod(std::string_view name, const MethodOptions& options = {});

// For any y' = f(t, y). Throws core::Error(usage) when there is no method of that name, or it needs x'' = a.
template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeFirstOrderMethod(std::string_view name);

// One for each file.
template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeExplicitEuler();
template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeHeun();
template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeMidpoint();
template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeRk4();
template <class Real>
std::unique_ptr<Method<Real>> makeSymplecticEuler();
template <class Real>
std::unique_ptr<Method<Real>> makeVelocityVerlet();
template <class Real>
std::unique_ptr<Method<Real>> makeLeapfrog();
template <class Real>
std::unique_ptr<Method<Real>> makeImplicitEuler(const MethodOptions& options);

double explicitEulerLargestStep(const FastestMode& mode);
double heunLargestStep(const FastestMode& mode);  // of the midpoint method too: on linear problems they are the same
double heunAutomaticStep(const FastestMode& mode);
double rk4LargestStep(const FastestMode& mode);
double symplecticEulerLargestStep(const FastestMode& mode);
double leapfrogLargestStep(const FastestMode& mode);
double implicitEulerLargestStep(const FastestMode& mode);

}  // namespace taut::ode
