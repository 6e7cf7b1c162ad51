#include "taut/ode/method_table.h"

#include <string>

#include "taut/core/error.h"
#include "taut/ode/private/stacked_method.h"

// One line for each method, in the order in which texts name them. It is the function that returns the method's row;
// each has its own file.
#define TAUT_METHODS(METHOD) \
    METHOD(explicitEuler)    \
    METHOD(symplecticEuler)  \
    METHOD(heun)             \
    METHOD(midpoint)         \
    METHOD(rungeKutta4)      \
    METHOD(velocityVerlet)   \
    METHOD(leapfrog)         \
    METHOD(blanesMoan)       \
    METHOD(implicitEuler)    \
    METHOD(sdirk2)

namespace taut::ode {

#define TAUT_DECLARE(method) MethodInfo method();
TAUT_METHODS(TAUT_DECLARE)
#undef TAUT_DECLARE

const Methods& builtInMethods() {
    static const Methods table = [] {
        Methods all;
#define TAUT_ADD(method) all.add(method());
        TAUT_METHODS(TAUT_ADD)
#undef TAUT_ADD
        return all;
    }();
    return table;
}

void Methods::add(const MethodInfo& method) {
    TAUT_EXPECTS(!method.title.empty() && method.largestStep != nullptr && method.automaticStep != nullptr);
    Table::add(method);
}

template <class Real>
std::unique_ptr<Method<Real>> Methods::make(std::string_view name, const MethodOptions& options) const {
    const MethodInfo* method = find(name);
    TAUT_EXPECTS(method != nullptr);
    if (method->isFirstOrder()) return makeStacked(method->make.firstOrder<Real>()());
    return method->make.secondOrder<Real>()(options);
}

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> Methods::makeFirstOrder(std::string_view name) const {
    const MethodInfo* method = find(name);
    if (method != nullptr && method->isFirstOrder()) return method->make.firstOrder<Real>()();
    std::string names;  // "a, b, c"
    for (const MethodInfo& other : all())
        if (other.isFirstOrder()) names += (names.empty() ? "" : ", ") + std::string(other.name);
    const std::string wrong = method == nullptr ? "there is no method \"" + std::string(name) + "\""
                                                : std::string(method->title) +
                                                      " needs x'' = a with positions and velocities apart, and this "
                                                      "problem is y' = f(t, y)";
    throw core::Error(core::ErrorKind::usage, wrong + "; these methods would do: " + names);
}

std::span<const MethodInfo> methods() {
    return builtInMethods().all();
}

const MethodInfo* findMethod(std::string_view name) {
    return builtInMethods().find(name);
}

template <class Real>
std::unique_ptr<Method<Real>> makeMethod(std::string_view name, const MethodOptions& options) {
    return builtInMethods().make<Real>(name, options);
}

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeFirstOrderMethod(std::string_view name) {
    return builtInMethods().makeFirstOrder<Real>(name);
}

template std::unique_ptr<Method<float>> Methods::make(std::string_view, const MethodOptions&) const;
template std::unique_ptr<Method<double>> Methods::make(std::string_view, const MethodOptions&) const;
template std::unique_ptr<FirstOrderMethod<float>> Methods::makeFirstOrder(std::string_view) const;
template std::unique_ptr<FirstOrderMethod<double>> Methods::makeFirstOrder(std::string_view) const;
template std::unique_ptr<Method<float>> makeMethod(std::string_view, const MethodOptions&);
template std::unique_ptr<Method<double>> makeMethod(std::string_view, const MethodOptions&);
template std::unique_ptr<FirstOrderMethod<float>> makeFirstOrderMethod(std::string_view);
template std::unique_ptr<FirstOrderMethod<double>> makeFirstOrderMethod(std::string_view);

}  // namespace taut::ode
