#include "taut/ode/method_table.h"

#include <string>

#include "taut/core/error.h"
#include "taut/ode/stacked_method.h"

namespace taut::ode {
namespace {

constexpr std::string_view growth =
    "motion that nothing damps grows at every step: dt = \"auto\" keeps it to a factor of e in 10 s";

// In the order in which texts name them.
constexpr MethodInfo table[] = {
    {.name = "euler",
     .title = "explicit Euler",
     .order = 1,
     .evaluations = 1,
     .storedArrays = 4,
     .symplectic = false,
     .reversible = false,
     .isFirstOrder = true,
     .limit = "2ζ; from ζ = 1 on 2(ζ - √(ζ²-1))",
     .caution = "motion that no dashpot damps, such as swinging, grows at every step",
     .largestStep = explicitEulerLargestStep,
     .automaticStep = explicitEulerLargestStep},
    {.name = "symplectic-euler",
     .title = "symplectic Euler",
     .order = 1,
     .evaluations = 1,
     .storedArrays = 0,
     .symplectic = true,
     .reversible = false,
     .isFirstOrder = false,
     .limit = "2(√(1+ζ²) - ζ) with dashpots, 2(√(1+ζ²) + ζ) with drag",
     .caution = "",
     .largestStep = symplecticEulerLargestStep,
     .automaticStep = symplecticEulerLargestStep},
    {.name = "heun",
     .title = "Heun",
     .order = 2,
     .evaluations = 2,
     .storedArrays = 8,
     .symplectic = false,
     .reversible = false,
     .isFirstOrder = true,
     .limit = "root of z³/4 - ζz² + 2ζ²z - 2ζ; from ζ = 1 on as Euler",
     .caution = growth,
     .largestStep = heunLargestStep,
     .automaticStep = heunAutomaticStep},
    {.name = "midpoint",
     .title = "midpoint",
     .order = 2,
     .evaluations = 2,
     .storedArrays = 6,
     .symplectic = false,
     .reversible = false,
     .isFirstOrder = true,
     .limit = "as Heun",
     .caution = growth,
     .largestStep = heunLargestStep,
     .automaticStep = heunAutomaticStep},
    {.name = "rk4",
     .title = "Runge-Kutta 4",
     .order = 4,
     .evaluations = 4,
     .storedArrays = 8,
     .symplectic = false,
     .reversible = false,
     .isFirstOrder = true,
     .limit = "2√2 at ζ = 0; from ζ = 1 on 2.785(ζ - √(ζ²-1)); between |R(w)| = 1",
     .caution = "",
     .largestStep = rk4LargestStep,
     .automaticStep = rk4LargestStep},
    {.name = "velocity-verlet",
     .title = "velocity Verlet",
     .order = 2,
     .evaluations = 1,
     .storedArrays = 3,
     .symplectic = true,
     .reversible = true,
     .isFirstOrder = false,
     .limit = "2 with drag, 2(√(1+4ζ²) - 2ζ) with dashpots",
     .caution = "",
     .largestStep = leapfrogLargestStep,
     .automaticStep = leapfrogLargestStep},
    {.name = "leapfrog",
     .title = "leap-frog",
     .order = 2,
     .evaluations = 1,
     .storedArrays = 1,
     .symplectic = true,
     .reversible = true,
     .isFirstOrder = false,
     .limit = "2 with drag, 2(√(1+4ζ²) - 2ζ) with dashpots",
     .caution = "",
     .largestStep = leapfrogLargestStep,
     .automaticStep = leapfrogLargestStep},
    {.name = "implicit-euler",
     .title = "implicit Euler",
     .order = 1,
     .evaluations = 1,
     .storedArrays = 12,
     .symplectic = false,
     .reversible = false,
     .isFirstOrder = false,
     .limit = "none on linear problems; solves by conjugate gradients, and damps by ζ = z/2",
     .caution = "",
     .largestStep = implicitEulerLargestStep,
     .automaticStep = implicitEulerLargestStep},
};

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> firstOrderOrNone(std::string_view name) {
    if (name == "euler") return makeExplicitEuler<Real>();
    if (name == "heun") return makeHeun<Real>();
    if (name == "midpoint") return makeMidpoint<Real>();
    if (name == "rk4") return makeRk4<Real>();
    return nullptr;
}

template <class Real>
std::unique_ptr<Method<Real>> secondOrderOrNone(std::string_view name, const MethodOptions& options) {
    if (name == "symplectic-euler") return makeSymplecticEuler<Real>();
    if (name == "velocity-verlet") return makeVelocityVerlet<Real>();
    if (name == "leapfrog") return makeLeapfrog<Real>();
    if (name == "implicit-euler") return makeImplicitEuler<Real>(options);
    return nullptr;
}

// "a, b, c"
std::string firstOrderNames() {
    std::string names;
    for (const MethodInfo& method : table)
        if (method.isFirstOrder) names += (names.empty() ? "" : ", ") + std::string(method.name);
    return names;
}

}  // namespace

std::span<const MethodInfo> methods() {
    return table;
}

const MethodInfo* findMethod(std::string_view name) {
    for (const MethodInfo& method : table)
        if (method.name == name) return &method;
    return nullptr;
}

template <class Real>
std::unique_ptr<Method<Real>> makeMethod(std::string_view name, const MethodOptions& options) {
    if (auto method = firstOrderOrNone<Real>(name)) return makeStacked(std::move(method));
    auto method = secondOrderOrNone<Real>(name, options);
    TAUT_EXPECTS(method != nullptr);
    return method;
}

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeFirstOrderMethod(std::string_view name) {
    if (auto method = firstOrderOrNone<Real>(name)) return method;
    const MethodInfo* known = findMethod(name);
    const std::string wrong = known == nullptr ? "there is no method \"" + std::string(name) + "\""
                                               : std::string(known->title) +
                                                     " needs x'' = a with positions and velocities apart, and this "
                                                     "problem is y' = f(t, y)";
    throw core::Error(core::ExitCode::usage, wrong + "; these methods would do: " + firstOrderNames());
}

template std::unique_ptr<Method<float>> makeMethod(std::string_view, const MethodOptions&);
template std::unique_ptr<Method<double>> makeMethod(std::string_view, const MethodOptions&);
template std::unique_ptr<FirstOrderMethod<float>> makeFirstOrderMethod(std::string_view);
template std::unique_ptr<FirstOrderMethod<double>> makeFirstOrderMethod(std::string_view);

}  // namespace taut::ode
