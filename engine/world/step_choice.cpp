#include "taut/world/step_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

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

// The longest step [s] of which it is not sure that the mode grows beyond all bounds, whatever damps it. Methods with a
// caution are given steps at which undamped motion grows slowly; at four times those, by 64 times as much or more.
double longestBearable(const ode::MethodInfo& method, ode::FastestMode mode) {
    const double damped = method.automaticStep(mode);
    mode.tau = mode.rate = mode.drag = mode.largestDrag = 0;
    return (method.caution.empty() ? 1 : 4) * std::max(damped, method.automaticStep(mode));
}

void warnOverLimit(const Envelope& envelope, const ode::MethodInfo& method, StepChoice& choice, double limitHere,
                   const std::function<double()>& leastOmega) {
    const Body& body = *envelope.plan.bodies.front();
    const std::string title(method.title), name = body.fullName(),
                                           step = name + ": the step of " + inSeconds(choice.step);
    const std::string by = choice.limitingSpring.empty() ? "" : "; set by the " + choice.limitingSpring;
    if (choice.limit == 0) {
        choice.warnings.push_back(name + ": " + title +
                                  " is unstable for every step here: nothing damps its fastest motion" + by);
        return;
    }
    if (choice.step <= choice.limit * (1 + 1e-9)) return;
    if (choice.step <= limitHere * (1 + 1e-9)) {
        choice.warnings.push_back(step + " is within the stability limit as the scene starts, " + inSeconds(limitHere) +
                                  ", but over the one that holds in any shape, " + inSeconds(choice.limit) + by);
        return;
    }
    ode::FastestMode mode = choice.mode;
    mode.omega = leastOmega();
    const double bearable = longestBearable(method, mode);
    const bool isSure = choice.step > bearable * (1 + 1e-9);
    const std::string text = step + " is over the stability limit of " + title + ", " +
                             inSeconds(isSure ? bearable : limitHere) + " as the scene starts: it " +
                             (isSure ? "will" : "may") + " diverge" + by;
    choice.warnings.push_back(text);
    if (isSure && envelope.plan.solver.onDivergence == OnDivergence::stop)
        choice.fault = at(body.spec->source) + text + "; give dt = \"auto\", or " + inSeconds(choice.limit) +
                       " or less, which holds in any shape";
}

std::string plain(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

// "0.9 mm", "1.2 m"
std::string lengthText(double length) {
    return length < 0.1 ? plain(1e3 * length) + " mm" : plain(length) + " m";
}

// The edge of a mesh that is far shorter than the others, by which the limiting spring or a neighbour is stiff.
void adviseOnSliver(const IslandPlan& plan, StepChoice& choice) {
    constexpr double shortEdge = 0.2;  // of the median: a step grows with the square of an edge
    if (!choice.anywhere.bySprings || choice.anywhere.spring < 0) return;
    const mechanics::Spring& limiting = plan.springs[static_cast<std::size_t>(choice.anywhere.spring)];
    const int number = plan.origins[static_cast<std::size_t>(choice.anywhere.spring)].body;
    if (number < 0) return;
    const Body& body = *plan.bodies[static_cast<std::size_t>(number)];
    const MeshSource* source = std::as_const(*body.spec).meshSource();
    if (source == nullptr || source->meshData == nullptr) return;

    const mechanics::Spring* shortest = nullptr;
    std::vector<double> lengths;
    for (std::size_t i = 0; i < plan.springs.size(); ++i) {
        const mechanics::Spring& s = plan.springs[i];
        if (plan.origins[i].body != number || s.kind != mechanics::SpringKind::structural) continue;
        lengths.push_back(s.restLength);
        const bool isNear = s.a == limiting.a || s.a == limiting.b || s.b == limiting.a || s.b == limiting.b;
        if (isNear && (shortest == nullptr || s.restLength < shortest->restLength)) shortest = &s;
    }
    if (shortest == nullptr) return;
    std::nth_element(lengths.begin(), lengths.begin() + std::ssize(lengths) / 2, lengths.end());
    const double median = lengths[lengths.size() / 2];
    if (shortest->restLength > shortEdge * median) return;
    const auto vertex = [&](int point) {
        const auto own = static_cast<std::size_t>(authored(plan, point).second);
        return std::to_string(own < source->meshData->numbers.size() ? source->meshData->numbers[own] : 0);
    };
    choice.advice.push_back(body.fullName() + ": the edge between vertices " + vertex(shortest->a) + " and " +
                            vertex(shortest->b) + " of " + source->mesh + " is " + lengthText(shortest->restLength) +
                            " long, the median " + lengthText(median) +
                            ", and sets the step: merge by distance, or integrator = \"implicit-euler\"");
}

// A damping time with which the step is at least half as long as without any, where that is at least twice as long.
void adviseOnDamping(const IslandPlan& plan, const ode::MethodInfo& method, StepChoice& choice) {
    constexpr double worthIt = 2.0, nearly = 0.5;
    ode::FastestMode mode = choice.mode;
    const auto limitAt = [&](double tau) {
        mode.tau = tau;
        return method.automaticStep(mode);
    };
    const double tau = choice.mode.tau, without = limitAt(0.0);
    if (!(tau > 0) || !(choice.limit > 0) || !(without > worthIt * choice.limit) || !std::isfinite(without)) return;
    double smaller = 1e-9;  // powers of ten read well
    while (10.0 * smaller < tau && limitAt(10.0 * smaller) > nearly * without) smaller *= 10.0;
    if (!(limitAt(smaller) > worthIt * choice.limit)) return;
    const auto damped = std::find_if(plan.springs.begin(), plan.springs.end(),
                                     [&](const mechanics::Spring& s) { return s.dampingTime == tau; });
    const SpringOrigin& origin = plan.origins[static_cast<std::size_t>(damped - plan.springs.begin())];
    const std::string name =
        origin.body < 0 ? "a joint" : plan.bodies[static_cast<std::size_t>(origin.body)]->fullName();
    choice.advice.push_back(name + ": damping_time_s = " + plain(tau) + " sets the step: " + plain(smaller) +
                            " would allow one of " + inSeconds(limitAt(smaller)) + " instead of " +
                            inSeconds(choice.limit));
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

StepChoice chooseStep(const Envelope& envelope, mechanics::StabilityShare share, double tickSeconds,
                      const std::function<double()>& leastOmega) {
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
                        " would need more than a million steps a tick; " +
                        (plan.solver.dt ? "give a longer dt, or dt = \"auto\""
                                        : "set by the " + choice.limitingSpring +
                                              "; soften it, give its points more mass, or use fewer cells"));
    choice.substeps = std::max(1, static_cast<int>(substeps));
    choice.step = tickSeconds / choice.substeps;
    if (!method->caution.empty())
        choice.warnings.push_back(body.fullName() + ": " + std::string(method->title) + ": " +
                                  std::string(method->caution));
    warnOverLimit(envelope, *method, choice, limitHere, leastOmega);
    if (std::isfinite(choice.limit)) {
        adviseOnSliver(plan, choice);
        adviseOnDamping(plan, *method, choice);
    }
    return choice;
}

}  // namespace taut::world
