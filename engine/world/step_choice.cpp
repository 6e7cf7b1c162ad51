#include "taut/world/step_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/core/error.h"

namespace taut::world {
namespace {

using core::Error;
using core::ExitCode;

constexpr double mostSubsteps = 1e6;

ode::FastestMode fastestMode(const Envelope& envelope, const mechanics::StabilityShare& share, double omega) {
    ode::FastestMode mode;
    mode.omega = omega;
    for (const mechanics::Spring& spring : envelope.plan.springs) mode.tau = std::max(mode.tau, spring.dampingTime);
    for (double rate : share.dampingRate) mode.rate = std::max(mode.rate, rate);
    mode.drag = envelope.leastDrag;
    mode.largestDrag = envelope.mostDrag;
    return mode;
}

// Some methods need damping, others bear little of it: the step has to hold with the most and with the least.
double automaticStep(const ode::MethodInfo& method, const Envelope& envelope, ode::FastestMode mode) {
    const double most = method.automaticStep(mode);
    mode.tau = std::min(mode.tau, envelope.leastTau);
    return std::min(most, method.automaticStep(mode));
}

void warnOverLimit(const IslandPlan& plan, const ode::MethodInfo& method, StepChoice& choice, double limitHere) {
    const std::string name = plan.bodies.front()->fullName();
    const std::string by = choice.limitingSpring.empty() ? "" : "; set by the " + choice.limitingSpring;
    if (choice.limit == 0) {
        choice.warnings.push_back(name + ": " + std::string(method.title) +
                                  " is unstable for every step here: nothing damps its fastest motion" + by);
    } else if (choice.step > limitHere * (1 + 1e-9)) {
        choice.warnings.push_back(name + ": the step of " + inSeconds(choice.step) + " is over the stability limit of " +
                                  std::string(method.title) + ", " + inSeconds(limitHere) +
                                  " as the scene starts: it will diverge" + by);
    } else if (choice.step > choice.limit * (1 + 1e-9)) {
        choice.warnings.push_back(name + ": the step of " + inSeconds(choice.step) +
                                  " is within the stability limit as the scene starts, " + inSeconds(limitHere) +
                                  ", but over the one that holds in any shape, " + inSeconds(choice.limit) + by);
    }
}

}  // namespace

double stepLimit(const IslandPlan& plan, const mechanics::StabilityShare& share) {
    std::vector<double> inverseMasses;
    Envelope now;
    now.leastDrag = HUGE_VAL;
    for (const auto& point : plan.points) {
        inverseMasses.push_back(point.held ? 0.0 : 1.0 / point.mass);
        if (!point.held) now.leastDrag = std::min(now.leastDrag, point.dragRate);
        if (!point.held) now.mostDrag = std::max(now.mostDrag, point.dragRate);
    }
    now.plan.springs = plan.springs;
    const double omega = mechanics::boundAnywhere({plan.springs, inverseMasses}, share.stiffness).omega;
    const ode::MethodInfo& method = *methodsOf(plan.solver).find(plan.solver.integrator);
    return method.automaticStep(fastestMode(now, share, omega));
}

std::string inSeconds(double t) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g s", t);
    return text;
}

StepChoice chooseStep(const Envelope& envelope, mechanics::StabilityShare share, double tickSeconds) {
    const IslandPlan& plan = envelope.plan;
    for (std::size_t i = 0; i < envelope.handStiffness.size(); ++i) {
        share.stiffness[i] += envelope.handStiffness[i];
        share.dampingRate[i] += envelope.handRate[i];
    }
    std::vector<double> inverseMasses;
    for (const auto& point : plan.points) inverseMasses.push_back(point.held ? 0.0 : 1.0 / point.mass);
    const mechanics::NetworkView network{plan.springs, inverseMasses};
    const ode::MethodInfo* method = methodsOf(plan.solver).find(plan.solver.integrator);
    const Body& body = *plan.bodies.front();
    if (method == nullptr)
        throw Error(ExitCode::badContent, at(body.spec->source) + "no method \"" + plan.solver.integrator + "\"");

    StepChoice choice;
    choice.anywhere = mechanics::boundAnywhere(network, share.stiffness);
    choice.here = mechanics::boundHere(network, share.stiffness, plan.positions);
    if (!choice.anywhere.bySprings)
        choice.limitingSpring = "volume cells, anchors or hands of " + body.fullName();
    else if (choice.anywhere.spring >= 0)
        choice.limitingSpring = describeSpring(plan, choice.anywhere.spring);
    choice.mode = fastestMode(envelope, share, choice.anywhere.omega);
    choice.limit = automaticStep(*method, envelope, choice.mode);
    const double limitHere = automaticStep(*method, envelope, fastestMode(envelope, share, choice.here.omega));

    const double wanted = plan.solver.dt ? *plan.solver.dt : plan.solver.safety * choice.limit;
    if (!(wanted > 0))
        throw Error(ExitCode::badContent, at(body.spec->source) + body.fullName() + ": dt = \"auto\" finds no step: " +
                                              std::string(method->title) +
                                              " is unstable for every step without damping; give dt in seconds, add "
                                              "damping, or choose another integrator");
    // A hair less, so that a dt of exactly a tick's part is not cut once more.
    const double substeps = std::ceil(tickSeconds / wanted * (1 - 1e-12));
    if (substeps > mostSubsteps)
        throw Error(ExitCode::badContent, at(body.spec->source) + body.fullName() + ": a step of " + inSeconds(wanted) +
                                              " would need more than a million steps a tick; set by the " +
                                              choice.limitingSpring + "; soften it, give its points more mass, or use fewer cells");
    choice.substeps = std::max(1, static_cast<int>(substeps));
    choice.step = tickSeconds / choice.substeps;
    if (!method->caution.empty())
        choice.warnings.push_back(body.fullName() + ": " + std::string(method->title) + ": " +
                                  std::string(method->caution));
    warnOverLimit(plan, *method, choice, limitHere);
    return choice;
}

}  // namespace taut::world
