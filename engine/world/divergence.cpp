#include "world/divergence.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "ode/method_table.h"

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

std::string explainDivergence(const Divergence& d, const Fault& fault, const StepChoice& choice,
                              const IslandPlan& plan, std::string_view methodTitle) {
    std::string text = format("%s diverged at t = %.4f s (tick %lld): point %d %s\n", d.body.c_str(), d.time,
                              static_cast<long long>(d.tick), d.point,
                              fault.isNumber ? "moves faster than 3000 m/s" : "has a velocity that is not a number");
    if (!d.spring.empty()) text += "  stiffest there: " + d.spring + "\n";
    const std::string title(methodTitle);
    if (d.limit > 0)
        text += format("  ω h = %.3g with h = %s; %s stands ω h < %.3g\n", d.omegaH, inSeconds(choice.step).c_str(),
                       title.c_str(), d.limit);
    else
        text += format("  ω h = %.3g with h = %s; %s stands no step without damping\n", d.omegaH,
                       inSeconds(choice.step).c_str(), title.c_str());
    if (d.safeStep > 0 && choice.step > d.safeStep)
        text += "  remedy: dt = " + inSeconds(d.safeStep) + " or less holds in any shape; dt = \"auto\" finds it\n";
    else if (d.limit > 0)
        text += "  the step is within the limit, so something else feeds energy in: look at colliders that move fast, "
                "winds, anchors, and working_stretch of blocks\n";
    for (const ode::MethodInfo& other : ode::methods()) {
        const double limit = other.largestStep(choice.mode);
        if (other.name == plan.solver.integrator || !(limit > 0) || !std::isfinite(limit)) continue;
        const double steps = std::ceil(choice.step * choice.substeps / (plan.solver.safety * limit));
        text += format("  %s would need %.0f force evaluations a tick; this run makes %d\n",
                       std::string(other.title).c_str(), steps * other.evaluations, choice.substeps);
    }
    text += "  the state of the tick before is kept";
    return text;
}

}  // namespace taut::world
