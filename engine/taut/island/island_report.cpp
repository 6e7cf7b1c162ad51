#include "taut/island/private/island_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/island/metric_table.h"
#include "taut/island/private/divergence.h"
#include "taut/mechanics/private/cell_shape.h"
#include "taut/plan/constraint.h"

namespace taut::world {
namespace {

void addPoints(const IslandPlan& plan, std::span<const dvec3> x, std::span<const dvec3> velocities,
               const std::vector<bool>& only, Metrics& metrics) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!only[i]) continue;
        const double m = plan.points[i].mass;
        const dvec3 v = velocities[i];
        metrics.kinetic += 0.5 * m * glm::dot(v, v);
        metrics.momentum += m * v;
        metrics.angularMomentum += m * glm::cross(x[i], v);
    }
}

void addSprings(const IslandPlan& plan, std::span<const dvec3> x, const std::vector<bool>& only, Metrics& metrics) {
    for (std::size_t i = 0; i < plan.springs.size(); ++i) {
        const mechanics::Spring& s = plan.springs[i];
        if (!only[s.a] || !only[s.b]) continue;
        if (plan.broken[i]) {
            ++metrics.brokenSprings;
            continue;
        }
        const double stretch = lengthOf(s, x) - s.restLength;
        metrics.elastic += 0.5 * s.stiffness * stretch * stretch;
        if (s.restLength > 0 && s.kind != mechanics::SpringKind::bend)
            metrics.maxStrain = std::max(metrics.maxStrain, std::abs(stretch) / s.restLength);
    }
    // Ties of joints of other kinds.
    for (const JointTie& tie : plan.ties)
        if (tie.springs.empty() && only[tie.a] && only[tie.b < 0 ? tie.a : tie.b] && !holds(plan, tie))
            ++metrics.brokenSprings;
}

void addCells(const Body& body, std::span<const dvec3> x, Metrics& metrics) {
    for (const mechanics::VolumeCell& cell : cellsOf(body)) {
        metrics.restVolume += cell.restVolume;
        metrics.volume += mechanics::volumeOf(mechanics::cornersOf(cell, x));
    }
}

// After a step, only points that touched something in it can be inside anything.
double penetrationOf(const Island& island, const std::vector<bool>& wanted) {
    double depth = 0;
    if (island.colliders().size() == 0) return depth;
    const auto look = [&](int point) {
        if (wanted[point] && isFree(island.plan(), point))
            depth = std::max(depth, -island.colliders().distance(island.position(point)));
    };
    if (island.hasMoved()) {
        for (const collision::Contact& contact : island.contacts()) look(contact.point);
        return depth;
    }
    for (const Body* body : island.plan().bodies)
        if (body->spec->collide && !body->spec->meetsCollidersAsWhole())
            for (int i = body->firstPoint; i < body->lastPoint; ++i) look(i);
    return depth;
}

std::string contactWarning(const Island& island) {
    const ContactBudget& budget = island.memory().budget;
    if (!budget.isOverdrawn()) return {};
    char text[300];
    std::snprintf(text, sizeof text,
                  ": contact has added %.2g J, %.0f %% of the most energy at a touch: the motion of a step of %s into "
                  "a collider is undone against its springs; ",
                  budget.most, 100.0 * budget.most / budget.sum.atTouch, inSeconds(island.step()).c_str());
    return island.plan().bodies.front()->fullName() + text +
           (island.plan().solver.dt ? "give dt = \"auto\", or a shorter one"
                                    : "give a shorter dt, or less restitution");
}

const ode::MethodInfo& methodOf(const Island& island) {
    return *methodsOf(island.plan().solver).find(island.plan().solver.integrator);
}

}  // namespace

void addMetrics(Island& island, const TickTime& time, const std::function<bool(const Body&)>& wanted,
                Metrics& metrics) {
    if (island.frozen() != nullptr) return;
    const IslandPlan& plan = island.plan();
    Dynamics& dynamics = island.dynamics();
    std::vector<bool> counts(plan.points.size(), false);
    for (const Body* body : plan.bodies)
        if (wanted(*body))
            for (int i : body->pointOf) counts[i] = true;
    std::vector<dvec3> x;
    dynamics.positions(x);
    const std::vector<dvec3> v = island.velocities(time);
    addMeasured({plan, x, v, counts}, metrics);
    addPoints(plan, x, v, counts, metrics);
    addSprings(plan, x, counts, metrics);
    metrics.maxStrain = std::max(metrics.maxStrain, dynamics.strain(time.start(), counts));
    for (const auto& [body, report] : dynamics.volumes(time.start(), false)) {
        if (!wanted(*body)) continue;
        metrics.minVolumeRatio = std::min(metrics.minVolumeRatio, report.smallestRatio);
        metrics.invertedCells += report.inverted;
    }
    dynamics.addEnergies(time.start(), counts, metrics.gravitational, metrics.elastic);
    for (const Body* body : plan.bodies)
        if (wanted(*body)) addCells(*body, x, metrics);
    for (const collision::Contact& contact : island.contacts()) metrics.contacts += counts[contact.point] ? 1 : 0;
    metrics.penetration = std::max(metrics.penetration, penetrationOf(island, counts));
    metrics.work += island.work();
    if (island.isAsleep()) metrics.asleep += static_cast<int>(std::count(counts.begin(), counts.end(), true));
    metrics.sleptEnergy += island.slept().energy;
    metrics.sleptMomentum += island.slept().momentum;
}

std::vector<std::string> warningsOf(const Island& island) {
    std::vector<std::string> all = island.choice().warnings;
    for (const std::string& warning : island.said()) all.push_back(warning);
    if (const std::string warning = contactWarning(island); !warning.empty()) all.push_back(warning);
    if (island.work().unconverged > 0) all.push_back(unconvergedWarning(island.work(), island.plan()));
    if (island.frozen() != nullptr)
        all.push_back(explainFreeze(*island.frozen(), island.choice(), methodOf(island).title));
    return all;
}

IslandInfo infoOf(const Island& island, const TickTime& time) {
    const IslandPlan& plan = island.plan();
    const Dynamics& dynamics = island.dynamics();
    const StepChoice choice = island.choice();
    IslandInfo info;
    info.name = plan.bodies.front()->fullName();
    for (const Body* body : plan.bodies) {
        info.bodies.push_back(body->fullName());
        info.cells += static_cast<int>(body->model.cells.size());
    }
    for (const auto& point : plan.points) info.mass += point.weighedMass();
    const std::vector<bool> isHeld = heldPointsOf(plan);
    info.heldPoints = static_cast<int>(std::count(isHeld.begin(), isHeld.end(), true));
    info.points = static_cast<int>(plan.points.size());
    info.springs = static_cast<int>(plan.springs.size());
    for (const auto& constraint : plan.constraints)
        (constraint->pulls().empty() ? info.constraints : info.springs) += constraint->count();
    dynamics.describe(info);
    info.method = plan.solver.integrator;
    info.omegaBound = choice.anywhere.omega;
    info.fastest = choice.mode;
    info.stepLimit = choice.limit;
    info.step = choice.step;
    info.substeps = choice.substeps;
    info.work = island.work();
    info.followsState = choice.need.has_value();
    info.stepChanges = island.memory().stepChanges;
    info.splitsDashpots = choice.splits;
    info.limitingSpring = choice.limitingSpring;
    info.advice = choice.advice;
    std::vector<dvec3> x;
    dynamics.positions(x);
    const std::vector<double> inverseMasses = inverseMassesOf(plan);
    const std::vector<mechanics::VolumeCell> cells = cellsOf(plan);
    info.omegaNow =
        mechanics::boundHere({plan.springs, inverseMasses, cells}, dynamics.stabilityShare(time.start()).stiffness, x)
            .omega;
    info.omegaEstimate = mechanics::estimateFrequency(inverseMasses, island.stiffnessAt(x));
    return info;
}

Divergence diagnose(const Island& island, const Fault& fault, const TickTime& time) {
    const IslandPlan& plan = island.plan();
    const StepChoice choice = island.choice();
    Divergence d;
    d.tick = time.tick;
    d.time = fault.time;
    if (const auto [body, point] = authored(plan, fault.point); body != nullptr) {
        d.body = body->fullName();
        d.point = point;
    }
    // The bound for the last good state, and the stiffest spring at that point, or of all if the point has none.
    const std::vector<double> inverseMasses = inverseMassesOf(plan);
    std::vector<dvec3> positions;
    island.dynamics().positions(positions);
    const std::vector<mechanics::VolumeCell> cells = cellsOf(plan);
    const mechanics::FrequencyBound here = mechanics::boundHere({plan.springs, inverseMasses, cells}, {}, positions);
    const mechanics::Spring* stiffest = nullptr;
    for (const mechanics::Spring& s : plan.springs)
        if ((s.a == fault.point || s.b == fault.point) && (stiffest == nullptr || s.stiffness > stiffest->stiffness))
            stiffest = &s;
    const int worst = stiffest == nullptr ? here.spring : static_cast<int>(stiffest - plan.springs.data());
    if (worst >= 0) d.spring = describeSpring(plan, worst);
    ode::FastestMode mode = choice.mode;
    mode.omega = std::max(here.omega, choice.here.omega);
    d.omegaH = mode.omega * choice.step;
    d.limit = mode.omega * methodOf(island).largestStep(mode);
    d.safeStep = choice.limit;
    d.message = explainDivergence(d, fault, choice, plan, methodOf(island).title);
    return d;
}

}  // namespace taut::world
