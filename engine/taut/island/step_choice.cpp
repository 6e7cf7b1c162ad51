#include "taut/island/private/step_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "taut/bodies/block.h"
#include "taut/core/error.h"

namespace taut::world {
namespace {

using core::Error;
using core::ErrorKind;

// The bounds of an island's plan, at its positions or in any shape.
class PlanBounds {
  public:
    PlanBounds(const IslandPlan& plan, std::span<const double> moreStiffness)
        : plan_(plan), more_(moreStiffness), inverseMasses_(inverseMassesOf(plan)), cells_(cellsOf(plan)) {
        for (const Body* body : plan.bodies)
            if (!body->model.cells.empty()) stretch_ = std::max(stretch_, body->model.workingStretch);
        for (const mechanics::Spring& spring : plan.springs) {
            dashpots_.push_back(spring);
            dashpots_.back().stiffness *= spring.dampingTime;
            dashpots_.back().restLength = HUGE_VAL;  // it acts only along the spring
        }
    }

    mechanics::FrequencyBound anywhere() const { return boundWithin(view(), more_, plan_.positions, stretch_); }
    mechanics::FrequencyBound here() const { return boundHere(view(), more_, plan_.positions); }
    // λ_max of M⁻¹C [1/s].
    double dampingAnywhere() const { return square(mechanics::boundAnywhere({dashpots_, inverseMasses_}, {}).omega); }
    double dampingHere() const {
        return square(mechanics::boundHere({dashpots_, inverseMasses_}, {}, plan_.positions).omega);
    }

  private:
    static double square(double value) { return value * value; }
    mechanics::NetworkView view() const { return {plan_.springs, inverseMasses_, cells_}; }

    const IslandPlan& plan_;
    std::span<const double> more_;
    std::vector<double> inverseMasses_;
    std::vector<mechanics::VolumeCell> cells_;
    std::vector<mechanics::Spring> dashpots_;
    double stretch_ = 1;
};

// leastDrag, mostDrag: over free points [1/s]. damping [1/s]: of the dashpots.
ode::FastestMode fastestMode(const mechanics::StabilityShare& share, double leastDrag, double mostDrag, double omega,
                             double damping) {
    ode::FastestMode mode{.omega = omega, .drag = leastDrag, .largestDrag = mostDrag};
    if (omega > 0) mode.tau = damping / (omega * omega);
    for (double rate : share.dampingRate) mode.rate = std::max(mode.rate, rate);
    return mode;
}

// Some methods need damping, others bear little of it. The step has to hold with the most and the least damping.
double automaticStep(const ode::MethodInfo& method, double leastTauShare, ode::FastestMode mode) {
    const double most = method.automaticStep(mode);
    mode.tau *= leastTauShare;
    return std::min(most, method.automaticStep(mode));
}

// For a method that splits the dashpots off. They act one after the other over y springs and drag velocities along.
// Above y = 1 (half before a kick, half after) they would reverse them.
double longestSplit(const ode::MethodInfo& method, const ode::FastestMode& undamped, double pairs) {
    constexpr double mostOfLimit = 0.98, mostY = 1.0;
    const double limit = mostOfLimit * method.automaticStep(undamped);
    return pairs > 0 ? std::min(limit, mostY / pairs) : limit;
}

// The longest step [s] at which the mode does not certainly grow beyond all bounds, with any damping. Methods with a
// caution get steps at which undamped motion grows slowly; at four times those it grows 64 times as much or more.
double longestBearable(const ode::MethodInfo& method, ode::FastestMode mode) {
    const double damped = method.automaticStep(mode);
    mode.tau = mode.rate = mode.drag = mode.largestDrag = 0;
    return (method.caution.empty() ? 1 : 4) * std::max(damped, method.automaticStep(mode));
}

void warnOverLimit(const Envelope& envelope, const ode::MethodInfo& method, StepChoice& choice, double limitHere,
                   const std::function<double()>& leastOmega) {
    const Body& body = limitingBody(envelope.plan, choice.anywhere);
    const std::string title(method.title), name = envelope.plan.bodies.front()->fullName(),
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

// Advises on an edge of a mesh that is far shorter than the others and makes the limiting spring or a neighbour stiff.
void adviseOnSliver(const IslandPlan& plan, StepChoice& choice) {
    constexpr double shortEdge = 0.2;  // of the median; the step grows with the square of an edge
    if (!choice.anywhere.bySprings || choice.anywhere.spring < 0) return;
    const mechanics::Spring& limiting = plan.springs[choice.anywhere.spring];
    const int number = plan.origins[choice.anywhere.spring].body;
    if (number < 0) return;
    const Body& body = *plan.bodies[number];
    const MeshSource* source = std::as_const(*body.spec).meshSource();
    if (source == nullptr || source->meshData == nullptr || source->mesh.empty()) return;
    if (dynamic_cast<const BlockSpec*>(body.spec.get()) != nullptr) return;  // its points are not the vertices

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

// Advises a damping time with which the step is at least half as long as without damping, if that doubles the step.
// substepsWith(share): substeps of a tick with all damping times multiplied by that share. All damping times are equal
// here, so one number states them.
void adviseOnDamping(const IslandPlan& plan, StepChoice& choice, const std::function<int(double)>& substepsWith) {
    constexpr double worthIt = 2.0, nearly = 0.5;
    const double tau = largestTau(plan);
    const bool isOne = std::all_of(plan.springs.begin(), plan.springs.end(), [&](const mechanics::Spring& s) {
        return s.dampingTime == tau || s.dampingTime == 0;
    });
    if (!(tau > 0) || !isOne) return;
    const double most = choice.substeps / worthIt;
    const int without = substepsWith(0.0);
    if (without > most) return;
    double smaller = 1e-9;  // powers of ten read well
    while (10.0 * smaller < tau && nearly * substepsWith(10.0 * smaller / tau) <= without) smaller *= 10.0;
    const int substeps = substepsWith(smaller / tau);
    if (substeps > most) return;
    choice.advice.push_back(plan.bodies.front()->fullName() + (plan.bodies.size() > 1 ? " and all joined to it" : "") +
                            ": damping_time_s = " + plain(tau) + " sets the step of " + inSeconds(choice.step) +
                            ": with " + plain(smaller) + " it is " +
                            inSeconds(choice.step * choice.substeps / substeps));
}

}  // namespace

const Body& limitingBody(const IslandPlan& plan, const mechanics::FrequencyBound& bound) {
    const int body = bound.bySprings && bound.spring >= 0 ? plan.origins[bound.spring].body : -1;
    return *plan.bodies[body < 0 ? 0 : static_cast<std::size_t>(body)];
}

double stepLimit(const IslandPlan& plan, const mechanics::StabilityShare& share) {
    double leastDrag = HUGE_VAL, mostDrag = 0;
    for (const mechanics::PointMass& point : plan.points) {
        if (point.held) continue;
        leastDrag = std::min(leastDrag, point.dragRate);
        mostDrag = std::max(mostDrag, point.dragRate);
    }
    const PlanBounds bounds(plan, share.stiffness);
    const ode::MethodInfo& method = *methodsOf(plan.solver).find(plan.solver.integrator);
    return method.automaticStep(
        fastestMode(share, leastDrag, mostDrag, bounds.anywhere().omega, bounds.dampingAnywhere()));
}

// Springs are not linear: near ω h = √3 a mode takes three steps to turn. There a step within the linear limit feeds
// wide swings (Schlick, Mandziuk, Skeel and Srinivas 1998, third-order resonance), unless dashpots take out more. A
// share of 0.9 keeps ω h below 1.5. Drag takes out too little to count.
constexpr double mostUndamped = 1.5 / 0.9, weakDamping = 0.02;  // ω h, and τ ω

double StepNeed::operator()(const mechanics::FastestNow& now) const {
    ode::FastestMode mode = others;
    const double omega2 = now.omega2 + moreOmega2;
    mode.omega = std::sqrt(omega2);
    if (splits) return tickSeconds / (safety * longestSplit(*method, mode, now.pairs));
    mode.tau = omega2 > 0 ? now.damping / omega2 : 0.0;
    double limit = automaticStep(*method, leastTauShare, mode);
    if (method->symplectic && mode.tau * leastTauShare * mode.omega < weakDamping)
        limit = std::min(limit, mostUndamped / mode.omega);
    return tickSeconds / (safety * limit);
}

void StepNeed::raise(const mechanics::StabilityShare& share, std::span<const double> inverseMasses) {
    for (std::size_t i = 0; i < inverseMasses.size(); ++i)
        moreOmega2 = std::max(moreOmega2, share.stiffness[i] * inverseMasses[i]);
    for (double rate : share.dampingRate) others.rate = std::max(others.rate, rate);
}

// A method without a limit takes one step a tick on its own. Springs in it then shake more than with shorter steps.
void warnOfTears(const IslandPlan& plan, const ode::MethodInfo& method, StepChoice& choice) {
    if (plan.solver.dt || !std::isinf(choice.limit)) return;
    for (const Body* body : plan.bodies)
        if (body->plasticity.breakStrain || body->plasticity.yieldStrain) {
            choice.warnings.push_back(
                body->fullName() + ": tears and yield are evaluated at every step, and " + std::string(method.title) +
                " takes one a tick: give a dt, such as 0.001, so that the picture rate has no say");
            return;
        }
}

// The cost of a step that splits the dashpots off, relative to one that does not: two extra sweeps over them.
constexpr double splitCosts = 2.5;

std::string inSeconds(double t) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g s", t);
    return text;
}

StepChoice chooseStep(const Envelope& envelope, mechanics::StabilityShare share, double tickSeconds,
                      const std::function<double()>& leastOmega, const mechanics::FastestNow* now,
                      const std::function<int(int)>& inParts) {
    const IslandPlan& plan = envelope.plan;
    for (std::size_t i = 0; i < envelope.handStiffness.size(); ++i) {
        share.stiffness[i] += envelope.handStiffness[i];
        share.dampingRate[i] += envelope.handRate[i];
    }
    const ode::MethodInfo* method = methodsOf(plan.solver).find(plan.solver.integrator);
    const Body& body = *plan.bodies.front();
    if (method == nullptr)
        throw Error(ErrorKind::badContent, at(body.spec->source) + "no method \"" + plan.solver.integrator + "\"");

    StepChoice choice;
    const PlanBounds bounds(plan, share.stiffness);
    choice.anywhere = bounds.anywhere();
    choice.here = bounds.here();
    if (!choice.anywhere.bySprings)
        choice.limitingSpring = "volume cells, anchors or hands of " + body.fullName();
    else if (choice.anywhere.spring >= 0)
        choice.limitingSpring = describeSpring(plan, choice.anywhere.spring);
    const auto modeAt = [&](double omega, double damping) {
        return fastestMode(share, envelope.leastDrag, envelope.mostDrag, omega, damping);
    };
    const double tau = largestTau(plan), leastTauShare = tau > 0 ? std::min(1.0, envelope.leastTau / tau) : 1.0;
    const double damping = bounds.dampingAnywhere();
    choice.mode = modeAt(choice.anywhere.omega, damping);
    const double limitHere = automaticStep(*method, leastTauShare, modeAt(choice.here.omega, bounds.dampingHere()));

    // The step [s] with that part of the damping, and its cause.
    const auto wantedStep = [&](double part, StepChoice& of) {
        of.limit = automaticStep(*method, leastTauShare, modeAt(choice.anywhere.omega, part * damping));
        if (plan.solver.dt) return *plan.solver.dt;
        // The limit of motion that turns on rods depends on its state.
        const bool isBounded = std::isfinite(of.limit) ||
                               (!plan.constraints.empty() && std::isfinite(method->automaticStep({.omega = 1.0})));
        if (now == nullptr || !method->caution.empty() || !isBounded) return plan.solver.safety * of.limit;
        const mechanics::FastestNow then{now->omega2, part * now->damping, part * now->pairs};
        of.need = StepNeed{method, tickSeconds, plan.solver.safety, modeAt(0, 0), 0, leastTauShare};
        of.need->raise(share, inverseMassesOf(plan));
        StepNeed split = *of.need;
        split.splits = true;
        const bool isCheaper = splitCosts * split(then) < (*of.need)(then);
        if (plan.solver.integrator == "leapfrog" && plan.solver.dashpots != Dashpots::extrapolated &&
            (isCheaper || plan.solver.dashpots == Dashpots::split))
            of.need = split;
        of.splits = of.need->splits;
        const double need = (*of.need)(then);
        return need > 0 ? tickSeconds / need : HUGE_VAL;
    };
    // Rounds up with a small tolerance, so that a dt of exactly a tick's part is not divided once more.
    const auto substepsOf = [&](double step) { return std::max(1.0, std::ceil(tickSeconds / step * (1 - 1e-12))); };

    const double wanted = wantedStep(1.0, choice);
    if (!(wanted > 0))
        throw Error(ErrorKind::badContent, at(body.spec->source) + body.fullName() +
                                               ": dt = \"auto\" finds no step: " + std::string(method->title) +
                                               " is unstable for every step without damping; give dt in seconds, add "
                                               "damping, or choose another integrator");
    const double substeps = substepsOf(wanted);
    if (substeps > mostSubsteps)
        throw Error(ErrorKind::badContent,
                    at(body.spec->source) + body.fullName() + ": a step of " + inSeconds(wanted) +
                        " would need more than a million steps a tick; " +
                        (plan.solver.dt ? "give a longer dt, or dt = \"auto\""
                                        : "set by the " + choice.limitingSpring +
                                              "; soften it, give its points more mass, or use fewer cells"));
    choice.substeps = inParts(static_cast<int>(substeps));
    choice.step = tickSeconds / choice.substeps;
    if (!method->caution.empty())
        choice.warnings.push_back(body.fullName() + ": " + std::string(method->title) + ": " +
                                  std::string(method->caution));
    warnOfTears(plan, *method, choice);
    if (!choice.need) warnOverLimit(envelope, *method, choice, limitHere, leastOmega);
    if (std::isfinite(choice.limit)) {
        adviseOnSliver(plan, choice);
        if (!plan.solver.dt && leastTauShare == 1.0)
            adviseOnDamping(plan, choice, [&](double part) {
                StepChoice tried;
                return inParts(static_cast<int>(std::min(substepsOf(wantedStep(part, tried)), 1.0 * mostSubsteps)));
            });
    }
    return choice;
}

}  // namespace taut::world
