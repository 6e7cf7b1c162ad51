// What an island says of itself: energies, frequencies, and why it stopped.
#include <algorithm>
#include <cmath>

#include "taut/world/divergence.h"
#include "taut/world/island_of.h"

namespace taut::world {

template <class Real>
void IslandOf<Real>::addMetrics(const TickTime& time, const std::function<bool(const Body&)>& wanted,
                                Metrics& metrics) {
    if (frozen_) return;
    const double t = time.start();
    ask(time);
    std::vector<bool> counts(plan_.points.size(), false);
    for (const Body* body : plan_.bodies)
        if (wanted(*body))
            for (int i : body->pointOf) counts[static_cast<std::size_t>(i)] = true;
    const auto isIn = [&](int point) { return counts[static_cast<std::size_t>(point)]; };
    for (int i = 0; i < system_.layout().count; ++i) {
        if (!isIn(i)) continue;
        const double m = plan_.points[static_cast<std::size_t>(i)].mass;
        const dvec3 x = at(state_.x, i), v = at(velocity_, i);
        metrics.kinetic += 0.5 * m * glm::dot(v, v);
        metrics.momentum += m * v;
        metrics.angularMomentum += m * glm::cross(x, v);
    }
    for (std::size_t i = 0; i < plan_.springs.size(); ++i) {
        const mechanics::Spring& s = plan_.springs[i];
        if (!isIn(s.a) || !isIn(s.b)) continue;
        if (plan_.broken[i]) {
            ++metrics.brokenSprings;
            continue;
        }
        const double stretch = lengthOf(s) - s.restLength;
        metrics.elastic += 0.5 * s.stiffness * stretch * stretch;
        if (s.restLength > 0 && s.kind != mechanics::SpringKind::bend)
            metrics.maxStrain = std::max(metrics.maxStrain, std::abs(stretch) / s.restLength);
    }
    for (const VolumeOf& entry : volumes_) {
        if (!wanted(*entry.body)) continue;
        const mechanics::VolumeReport state = entry.volume->inspect(motion(t));
        metrics.minVolumeRatio = std::min(metrics.minVolumeRatio, state.smallestRatio);
        metrics.invertedCells += state.inverted;
    }
    for (const auto& generator : system_.generators()) {
        double& kind = generator->isUniform() ? metrics.gravitational : metrics.elastic;
        kind += generator->potentialEnergy(motion(t), counts);
    }
    for (const Body* body : plan_.bodies) {
        if (!wanted(*body)) continue;
        for (std::size_t c = 0; c < body->model.cells.size(); ++c) {
            if (body->damage.isCellGone(c)) continue;
            const auto corner = [&](std::size_t k) {
                const auto point = static_cast<std::size_t>(body->model.cells[c].points[k]);
                return at(state_.x, body->pointOf[point]);
            };
            const dvec3 p = corner(0);
            metrics.restVolume += body->model.cells[c].restVolume;
            metrics.volume += glm::dot(corner(1) - p, glm::cross(corner(2) - p, corner(3) - p)) / 6.0;
        }
    }
    for (const collision::Contact& contact : contacts_) metrics.contacts += isIn(contact.point) ? 1 : 0;
    metrics.penetration = std::max(metrics.penetration, penetration(counts));
    metrics.work += work();
}

// Only points that touched something in the last step can be inside anything, once there has been a step.
template <class Real>
double IslandOf<Real>::penetration(const std::vector<bool>& wanted) const {
    double depth = 0;
    if (colliders_.size() == 0) return depth;
    const auto look = [&](int point) {
        const auto k = static_cast<std::size_t>(point);
        if (wanted[k] && system_.inverseMasses()[k] > Real(0))
            depth = std::max(depth, -colliders_.distance(at(state_.x, point)));
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

template <class Real>
ode::Work IslandOf<Real>::work() const {
    ode::Work sum = workBefore_;
    sum += method_->work();
    return sum -= workOfQueries_;
}

template <class Real>
std::vector<std::string> IslandOf<Real>::warnings() const {
    std::vector<std::string> all = choice_.warnings;
    for (const std::string& warning : {stretchWarning_, collapseWarning_, limitWarning_})
        if (!warning.empty()) all.push_back(warning);
    if (work().unconverged > 0) all.push_back(unconvergedWarning(work(), plan_));
    if (frozen_) all.push_back(explainFreeze(*frozen_, choice_, methodTitle()));
    return all;
}

template <class Real>
IslandInfo IslandOf<Real>::info() const {
    IslandInfo info;
    info.name = plan_.bodies.front()->fullName();
    std::vector<double> inverseMasses;
    for (const Body* body : plan_.bodies) {
        info.bodies.push_back(body->fullName());
        info.cells += static_cast<int>(body->model.cells.size());
    }
    for (const auto& point : plan_.points) {
        info.mass += point.mass;
        info.heldPoints += point.held ? 1 : 0;
        inverseMasses.push_back(point.held ? 0.0 : 1.0 / point.mass);
    }
    info.points = static_cast<int>(plan_.points.size());
    info.springs = static_cast<int>(plan_.springs.size());
    info.runs = static_cast<int>(system_.network().runs.size());
    info.singles = system_.network().singles.size();
    info.method = plan_.solver.integrator;
    info.omegaBound = choice_.anywhere.omega;
    info.omegaNow = choice_.here.omega;
    info.fastest = choice_.mode;
    info.stepLimit = choice_.limit;
    info.step = choice_.step;
    info.substeps = choice_.substeps;
    info.work = work();
    info.limitingSpring = choice_.limitingSpring;
    info.bytes = system_.bytes() + (3 + 2 * state_.memory.size()) * state_.layout.size() * sizeof(Real) * 2;
    core::AlignedArray<Real> u(state_.layout.size()), out(state_.layout.size());
    const mechanics::StiffnessProduct multiply = [&](std::span<const dvec3> in, std::span<dvec3> sum) {
        mechanics::addSpringStiffness(plan_.springs, plan_.positions, in, sum);
        std::fill(out.begin(), out.end(), Real(0));
        for (std::size_t i = 0; i < in.size(); ++i)
            for (int p = 0; p < 3; ++p) u[index(static_cast<int>(i), p)] = static_cast<Real>(in[i][p]);
        for (const auto& generator : system_.generators())
            generator->addStiffnessProduct(motion(0.0), u.data(), out.data());
        for (std::size_t i = 0; i < in.size(); ++i) sum[i] += at(out, static_cast<int>(i));
    };
    info.omegaEstimate = mechanics::estimateFrequency(inverseMasses, multiply);
    return info;
}

template <class Real>
Divergence IslandOf<Real>::diagnose(const Fault& fault, const TickTime& time) const {
    Divergence d;
    d.tick = time.tick;
    d.time = fault.time;
    for (const Body* body : plan_.bodies)
        for (std::size_t i = 0; i < body->pointOf.size() && d.point < 0; ++i)
            if (body->pointOf[i] == fault.point) {
                d.body = body->fullName();
                d.point = static_cast<int>(i);
            }
    // The bound at that point, for the last good state.
    std::vector<mechanics::Spring> around;
    std::vector<int> numbers;
    for (std::size_t s = 0; s < plan_.springs.size(); ++s)
        if (plan_.springs[s].a == fault.point || plan_.springs[s].b == fault.point)
            numbers.push_back(static_cast<int>(s));
    std::vector<double> inverseMasses;
    std::vector<dvec3> positions;
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
        inverseMasses.push_back(plan_.points[i].held ? 0.0 : 1.0 / plan_.points[i].mass);
        positions.push_back(position(static_cast<int>(i)));
    }
    const mechanics::FrequencyBound here = mechanics::boundHere({plan_.springs, inverseMasses}, {}, positions);
    int worst = numbers.empty() ? here.spring : numbers.front();
    for (int s : numbers)
        if (plan_.springs[static_cast<std::size_t>(s)].stiffness >
            plan_.springs[static_cast<std::size_t>(worst)].stiffness)
            worst = s;
    if (worst >= 0) d.spring = describeSpring(plan_, worst);
    const ode::MethodInfo* method = methodsOf(plan_.solver).find(plan_.solver.integrator);
    ode::FastestMode mode = choice_.mode;
    mode.omega = std::max(here.omega, choice_.here.omega);
    d.omegaH = mode.omega * choice_.step;
    d.limit = mode.omega * method->largestStep(mode);
    d.safeStep = choice_.limit;
    d.message = explainDivergence(d, fault, choice_, plan_, method->title);
    return d;
}

#define TAUT_ISLAND_REPORTS(Real)                                                                                 \
    template void IslandOf<Real>::addMetrics(const TickTime&, const std::function<bool(const Body&)>&, Metrics&); \
    template double IslandOf<Real>::penetration(const std::vector<bool>&) const;                                  \
    template ode::Work IslandOf<Real>::work() const;                                                              \
    template std::vector<std::string> IslandOf<Real>::warnings() const;                                           \
    template IslandInfo IslandOf<Real>::info() const;                                                             \
    template Divergence IslandOf<Real>::diagnose(const Fault&, const TickTime&) const;
TAUT_ISLAND_REPORTS(float)
TAUT_ISLAND_REPORTS(double)
#undef TAUT_ISLAND_REPORTS

}  // namespace taut::world
