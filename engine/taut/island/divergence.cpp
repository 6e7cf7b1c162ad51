#include "taut/island/private/divergence.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace taut::world {
namespace {

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(text, sizeof text, pattern, arguments);
    va_end(arguments);
    return text;
}

}  // namespace

std::string explainDivergence(const Divergence& d, const Fault& fault, const StepChoice& choice, const IslandPlan& plan,
                              std::string_view methodTitle) {
    const std::string why = fault.isTooStiff   ? "has become too stiff for a million steps a tick"
                            : fault.strain > 0 ? format("has a spring with a strain of %.3g", fault.strain)
                            : fault.isNumber   ? "moves faster than 3000 m/s"
                                               : "has a velocity that is not a number";
    std::string text = format("%s diverged at t = %.4f s (tick %lld): point %d %s%s\n", d.body.c_str(), d.time,
                              static_cast<long long>(d.tick), d.point, why.c_str(),
                              fault.byContact ? " after contact with other bodies" : "");
    if (!d.spring.empty()) text += "  stiffest there: " + d.spring + "\n";
    const std::string title(methodTitle);
    if (d.limit > 0 && !std::isfinite(d.limit))
        text += format("  ω h = %.3g with h = %s; %s has no limit as long as forces are linear\n", d.omegaH,
                       inSeconds(choice.step).c_str(), title.c_str());
    else if (d.limit > 0)
        text += format("  ω h = %.3g with h = %s; %s stands ω h < %.3g\n", d.omegaH, inSeconds(choice.step).c_str(),
                       title.c_str(), d.limit);
    else
        text += format("  ω h = %.3g with h = %s; %s stands no step without damping\n", d.omegaH,
                       inSeconds(choice.step).c_str(), title.c_str());
    if (d.safeStep > 0 && choice.step > d.safeStep)
        text += "  remedy: dt = " + inSeconds(d.safeStep) + " or less holds in any shape; dt = \"auto\" finds it\n";
    else if (fault.byContact)
        text += "  remedy: look for pressure there: bodies that start in another, or are led into it\n";
    else if (d.limit > 0)
        text +=
            "  the step is within the limit, so something else feeds energy in: look at colliders that move fast, "
            "winds, anchors, fillings, seams that close, and working_stretch of blocks\n";
    for (const ode::MethodInfo& other : methodsOf(plan.solver).all()) {
        const double limit = other.automaticStep(choice.mode);
        if (other.name == plan.solver.integrator || !(limit > 0)) continue;
        if (!std::isfinite(limit)) {
            text += format("  %s stands every step as long as forces are linear: integrator = \"%s\"\n",
                           std::string(other.title).c_str(), std::string(other.name).c_str());
            continue;
        }
        const double steps = std::ceil(choice.step * choice.substeps / (plan.solver.safety * limit));
        text += format("  %s would need %.0f force evaluations a tick; this run makes %d\n",
                       std::string(other.title).c_str(), steps * other.evaluations, choice.substeps);
    }
    const bool freezes = plan.solver.onDivergence == OnDivergence::freeze;
    text += freezes ? "  the state of the step before is kept" : "  the state of the tick before is kept";
    return text;
}

std::string unconvergedWarning(const ode::Work& work, const IslandPlan& plan) {
    const SolverSpec& solver = plan.solver;
    std::string text = format("%s: %lld solves of %s did not reach cg_tolerance = %.3g within cg_iterations = %d",
                              plan.bodies.front()->fullName().c_str(), static_cast<long long>(work.unconverged),
                              solver.integrator.c_str(), solver.cgTolerance, solver.cgIterations);
    if (solver.newtonSteps > 1)
        text += format(", or Newton's method not its end within newton_steps = %d", solver.newtonSteps);
    return text + "; the motion is less accurate than it seems: allow more, or shorten dt";
}

std::string explainFreeze(const FrozenIsland& frozen, const StepChoice& choice, std::string_view methodTitle) {
    const std::string others =
        frozen.bodies.size() > 1 ? format(" (with %zu more)", frozen.bodies.size() - 1) : std::string();
    return format("%s%s diverged at t = %.4f s under %s with h = %s and is frozen there; the rest continues",
                  frozen.name.c_str(), others.c_str(), frozen.divergence.time, std::string(methodTitle).c_str(),
                  inSeconds(choice.step).c_str());
}

}  // namespace taut::world
