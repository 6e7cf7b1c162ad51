// What an island says of itself: energies, frequencies, and why it stopped.
#include <algorithm>
#include <cmath>

#include "taut/island/divergence.h"
#include "taut/island/island.h"
#include "taut/bodies/joints/constraint.h"

namespace taut::world {

void Island::addMetrics(const TickTime& time, const std::function<bool(const Body&)>& wanted, Metrics& metrics) {
    if (frozen_) return;
    std::vector<bool> counts(plan_.points.size(), false);
    for (const Body* body : plan_.bodies)
        if (wanted(*body))
            for (int i : body->pointOf) counts[static_cast<std::size_t>(i)] = true;
    dynamics_->positions(x_);
    addPoints(counts, time, metrics);
    addSprings(counts, metrics);
    metrics.maxStrain = std::max(metrics.maxStrain, dynamics_->strain(time.start(), counts));
    for (const auto& [body, report] : dynamics_->volumes(time.start(), false)) {
        if (!wanted(*body)) continue;
        metrics.minVolumeRatio = std::min(metrics.minVolumeRatio, report.smallestRatio);
        metrics.invertedCells += report.inverted;
    }
    dynamics_->addEnergies(time.start(), counts, metrics.gravitational, metrics.elastic);
    for (const Body* body : plan_.bodies)
        if (wanted(*body)) addCells(*body, metrics);
    for (const collision::Contact& contact : contacts_)
        metrics.contacts += counts[static_cast<std::size_t>(contact.point)] ? 1 : 0;
    metrics.penetration = std::max(metrics.penetration, penetration(counts));
    metrics.work += work();
}

void Island::addPoints(const std::vector<bool>& only, const TickTime& time, Metrics& metrics) {
    const std::vector<dvec3> velocities = this->velocities(time);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (!only[i]) continue;
        const double m = plan_.points[i].mass;
        const dvec3 v = velocities[i];
        metrics.kinetic += 0.5 * m * glm::dot(v, v);
        metrics.momentum += m * v;
        metrics.angularMomentum += m * glm::cross(x_[i], v);
    }
}

void Island::addSprings(const std::vector<bool>& only, Metrics& metrics) {
    for (std::size_t i = 0; i < plan_.springs.size(); ++i) {
        const mechanics::Spring& s = plan_.springs[i];
        if (!only[static_cast<std::size_t>(s.a)] || !only[static_cast<std::size_t>(s.b)]) continue;
        if (plan_.broken[i]) {
            ++metrics.brokenSprings;
            continue;
        }
        const double stretch = lengthOf(s, x_) - s.restLength;
        metrics.elastic += 0.5 * s.stiffness * stretch * stretch;
        if (s.restLength > 0 && s.kind != mechanics::SpringKind::bend)
            metrics.maxStrain = std::max(metrics.maxStrain, std::abs(stretch) / s.restLength);
    }
}

void Island::addCells(const Body& body, Metrics& metrics) const {
    for (std::size_t c = 0; c < body.model.cells.size(); ++c) {
        if (body.damage.isCellGone(c)) continue;
        const mechanics::VolumeCell& cell = body.model.cells[c];
        const auto corner = [&](std::size_t k) {
            return x_[static_cast<std::size_t>(body.pointOf[static_cast<std::size_t>(cell.points[k])])];
        };
        const dvec3 p = corner(0);
        metrics.restVolume += cell.restVolume;
        metrics.volume += glm::dot(corner(1) - p, glm::cross(corner(2) - p, corner(3) - p)) / 6.0;
    }
}

// Only points that touched something in the last step can be inside anything, once there has been a step.
double Island::penetration(const std::vector<bool>& wanted) const {
    double depth = 0;
    if (colliders_.size() == 0) return depth;
    const auto look = [&](int point) {
        if (wanted[static_cast<std::size_t>(point)] && isFree(plan_, point))
            depth = std::max(depth, -colliders_.distance(position(point)));
    };
    if (hasMoved_) {
        for (const collision::Contact& contact : contacts_) look(contact.point);
        return depth;
    }
    for (const Body* body : plan_.bodies)
        if (body->spec->collide)
            for (int i = body->firstPoint; i < body->lastPoint; ++i) look(i);
    return depth;
}

ode::Work Island::work() const {
    ode::Work sum = workElsewhere_;
    return sum += dynamics_->work();
}

std::vector<std::string> Island::warnings() const {
    std::vector<std::string> all = choice_.warnings;
    all.insert(all.end(), insideWarnings_.begin(), insideWarnings_.end());
    for (const std::string& warning :
         {stretchWarning_, collapseWarning_, limitWarning_, freezingWarning_, contactWarning()})
        if (!warning.empty()) all.push_back(warning);
    if (work().unconverged > 0) all.push_back(unconvergedWarning(work(), plan_));
    if (frozen_) all.push_back(explainFreeze(*frozen_, choice_, method().title));
    return all;
}

IslandInfo Island::info(const TickTime& time) const {
    IslandInfo info;
    info.name = plan_.bodies.front()->fullName();
    for (const Body* body : plan_.bodies) {
        info.bodies.push_back(body->fullName());
        info.cells += static_cast<int>(body->model.cells.size());
    }
    for (const auto& point : plan_.points) info.mass += point.mass;
    const std::vector<bool> isHeld = heldPointsOf(plan_);
    info.heldPoints = static_cast<int>(std::count(isHeld.begin(), isHeld.end(), true));
    info.points = static_cast<int>(plan_.points.size());
    info.springs = static_cast<int>(plan_.springs.size());
    for (const auto& constraint : plan_.constraints) info.constraints += constraint->count();
    dynamics_->describe(info);
    info.method = plan_.solver.integrator;
    info.omegaBound = choice_.anywhere.omega;
    info.fastest = choice_.mode;
    info.stepLimit = choice_.limit;
    info.step = choice_.step;
    info.substeps = choice_.substeps;
    info.work = work();
    info.followsState = choice_.need.has_value();
    info.stepChanges = stepChanges_;
    info.splitsDashpots = choice_.splits;
    info.limitingSpring = choice_.limitingSpring;
    info.advice = choice_.advice;
    std::vector<dvec3> x;
    dynamics_->positions(x);
    const std::vector<double> inverseMasses = inverseMassesOf(plan_);
    const std::vector<mechanics::VolumeCell> cells = cellsOf(plan_);
    info.omegaNow = mechanics::boundHere({plan_.springs, inverseMasses, cells},
                                         dynamics_->stabilityShare(time.start()).stiffness, x)
                        .omega;
    info.omegaEstimate = mechanics::estimateFrequency(inverseMasses, stiffnessAt(x));
    return info;
}

mechanics::StiffnessProduct Island::stiffnessAt(std::span<const dvec3> x) const {
    return [this, x](std::span<const dvec3> in, std::span<dvec3> sum) {
        mechanics::addSpringStiffness(plan_.springs, x, in, sum);
        dynamics_->addStiffnessProduct(in, sum);
    };
}

Divergence Island::diagnose(const Fault& fault, const TickTime& time) const {
    Divergence d;
    d.tick = time.tick;
    d.time = fault.time;
    if (const auto [body, point] = authored(plan_, fault.point); body != nullptr) {
        d.body = body->fullName();
        d.point = point;
    }
    // The bound for the last good state, and the stiffest spring at that point or, where there is none, of all.
    const std::vector<double> inverseMasses = inverseMassesOf(plan_);
    std::vector<dvec3> positions;
    dynamics_->positions(positions);
    const std::vector<mechanics::VolumeCell> cells = cellsOf(plan_);
    const mechanics::FrequencyBound here = mechanics::boundHere({plan_.springs, inverseMasses, cells}, {}, positions);
    const mechanics::Spring* stiffest = nullptr;
    for (const mechanics::Spring& s : plan_.springs)
        if ((s.a == fault.point || s.b == fault.point) && (stiffest == nullptr || s.stiffness > stiffest->stiffness))
            stiffest = &s;
    const int worst = stiffest == nullptr ? here.spring : static_cast<int>(stiffest - plan_.springs.data());
    if (worst >= 0) d.spring = describeSpring(plan_, worst);
    ode::FastestMode mode = choice_.mode;
    mode.omega = std::max(here.omega, choice_.here.omega);
    d.omegaH = mode.omega * choice_.step;
    d.limit = mode.omega * method().largestStep(mode);
    d.safeStep = choice_.limit;
    d.message = explainDivergence(d, fault, choice_, plan_, method().title);
    return d;
}

}  // namespace taut::world
