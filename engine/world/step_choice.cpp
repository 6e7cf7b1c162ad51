#include "taut/world/step_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/core/error.h"

namespace taut::world {
namespace {

using core::Error;
using core::ErrorKind;

constexpr double mostSubsteps = 1e6;

// Drags [1/s]: the smallest and the largest of free points.
ode::FastestMode fastestMode(const IslandPlan& plan, const mechanics::StabilityShare& share, double leastDrag,
                             double mostDrag, double omega) {
    ode::FastestMode mode{.omega = omega, .drag = leastDrag, .largestDrag = mostDrag};
    for (const mechanics::Spring& spring : plan.springs) mode.tau = std::max(mode.tau, spring.dampingTime);
    for (double rate : share.dampingRate) mode.rate = std::max(mode.rate, rate);
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
        choice.warnings.push_back(name + ": the step of " + inSeconds(choice.step) +
                                  " is over the stability limit of " + std::string(method.title) + ", " +
                                  inSeconds(limitHere) + " as the scene starts: it will diverge" + by);
    } else if (choice.step > choice.limit * (1 + 1e-9)) {
        choice.warnings.push_back(name + ": the step of " + inSeconds(choice.step) +
                                  " is within the stability limit as the scene starts, " + inSeconds(limitHere) +
                                  ", but over the one that holds in any shape, " + inSeconds(choice.limit) + by);
    }
}

}  // namespace

double stepLimit(const IslandPlan& plan, const mechanics::StabilityShare& share) {
    double leastDrag = HUGE_VAL, mostDrag = 0;
    for (const mechanics::PointMass& point : plan.points) {
        if (point.held) continue;
        leastDrag = std::min(leastDrag, point.dragRate);
        mostDrag = std::max(mostDrag, point.dragRate);
    }
    const double omega = mechanics::boundAnywhere({plan.springs, inverseMassesOf(plan)}, share.stiffness).omega;
    const ode::MethodInfo& method = *methodsOf(plan.solver).find(plan.solver.integrator);
    return method.automaticStep(fastestMode(plan, share, leastDrag, mostDrag, omega));
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
    const std::vector<double> inverseMasses = inverseMassesOf(plan);
    const mechanics::NetworkView network{plan.springs, inverseMasses};
    const ode::MethodInfo* method = methodsOf(plan.solver).find(plan.solver.integrator);
    const Body& body = *plan.bodies.front();
    if (method == nullptr)
        throw Error(ErrorKind::badContent, at(body.spec->source) + "no method \"" + plan.solver.integrator + "\"");

    StepChoice choice;
    choice.anywhere = mechanics::boundAnywhere(network, share.stiffness);
    choice.here = mechanics::boundHere(network, share.stiffness, plan.positions);
    if (!choice.anywhere.bySprings)
        choice.limitingSpring = "volume cells, anchors or hands of " + body.fullName();
    else if (choice.anywhere.spring >= 0)
        choice.limitingSpring = describeSpring(plan, choice.anywhere.spring);
    const auto modeAt = [&](double omega) {
        return fastestMode(plan, share, envelope.leastDrag, envelope.mostDrag, omega);
    };
    choice.mode = modeAt(choice.anywhere.omega);
    choice.limit = automaticStep(*method, envelope, choice.mode);
    const double limitHere = automaticStep(*method, envelope, modeAt(choice.here.omega));

    const double wanted = plan.solver.dt ? *plan.solver.dt : plan.solver.safety * choice.limit;
    if (!(wanted > 0))
        throw Error(ErrorKind::badContent, at(body.spec->source) + body.fullName() +
                                               ": dt = \"auto\" finds no step: " + std::string(method->title) +
                                               " is unstable for every step without damping; give dt in seconds, add "
                                               "damping, or choose another integrator");
    // A hair less, so that a dt of exactly a tick's part is not cut once more.
    const double substeps = std::ceil(tickSeconds / wanted * (1 - 1e-12));
    if (substeps > mostSubsteps)
        throw Error(ErrorKind::badContent,
                    at(body.spec->source) + body.fullName() + ": a step of " + inSeconds(wanted) +
                        " would need more than a million steps a tick; set by the " + choice.limitingSpring +
                        "; soften it, give its points more mass, or use fewer cells");
    choice.substeps = std::max(1, static_cast<int>(substeps));
    choice.step = tickSeconds / choice.substeps;
    if (!method->caution.empty())
        choice.warnings.push_back(body.fullName() + ": " + std::string(method->title) + ": " +
                                  std::string(method->caution));
    warnOverLimit(plan, *method, choice, limitHere);
    return choice;
}

}  // namespace taut::world
