#include "taut/plan/private/strain_limit.h"

#include <algorithm>
#include <cmath>

#include "taut/plan/island_plan.h"

namespace taut::world {
namespace {

constexpr int turnsOfPlaces = 10000, turnsOfVelocities = 6;  // places alone keep the limit
constexpr int turnsOfSome = 10;
constexpr double straight = 0.995;  // cosine of the largest turn in a step that does not change a direction
constexpr double nearly = 0.98;     // of the longest length
// Of the longest length: by so much less springs are stopped, and by so much more a state may be off.
constexpr double margin = 1e-3;
constexpr double settledSpeed = 1e-3;  // of the speeds of the two ends

double sizeOf(const dvec3& v) {
    return std::sqrt(glm::dot(v, v));
}

// The limit of a spring's body, if it has one that counts for this spring.
std::optional<double> limitOf(const IslandPlan& plan, std::size_t s) {
    const int body = plan.origins[s].body;
    if (body < 0 || plan.springs[s].kind == mechanics::SpringKind::bend) return std::nullopt;
    return plan.bodies[body]->plasticity.strainLimit;
}

// Of projections. Below 2 each of them takes energy; the longer the chain, the nearer to 2 converges fastest.
double relaxationOf(int turn) {
    return 2.0 - 0.3 / (1.0 + 0.03 * turn);
}

}  // namespace

bool StrainLimit::isIn(const IslandPlan& plan) {
    return std::any_of(
        plan.bodies.begin(), plan.bodies.end(),
        [](const Body* body) { return body->plasticity.strainLimit.has_value(); });
}

StrainLimit::StrainLimit(const IslandPlan& plan) {
    for (std::size_t s = 0; s < plan.springs.size(); ++s)
        if (limitOf(plan, s)) points_.insert(points_.end(), {plan.springs[s].a, plan.springs[s].b});
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    follow(plan);
}

void StrainLimit::follow(const IslandPlan& plan) {
    const auto numberOf = [&](int point) {
        return static_cast<int>(std::lower_bound(points_.begin(), points_.end(), point) - points_.begin());
    };
    links_.clear();
    for (std::size_t s = 0; s < plan.springs.size(); ++s)
        if (const auto limit = limitOf(plan, s); limit && !plan.broken[s]) {
            const mechanics::Spring& spring = plan.springs[s];
            links_.push_back(
                {numberOf(spring.a), numberOf(spring.b), (1.0 + *limit) * (1.0 - 2 * margin) * spring.restLength});
        }
}

template <class Project>
bool StrainLimit::takeTurns(std::span<const dvec3> x, int mostTurns, const Project& project) {
    bool any = false, isOfAll = false;
    for (int turn = 0, left = 0; turn < mostTurns; ++turn, --left) {
        isOfAll = left == 0;
        if (isOfAll) {
            left = turnsOfSome;
            long_.clear();
            for (const Link& link : links_) {
                const dvec3 d = x[link.b] - x[link.a];
                if (glm::dot(d, d) > nearly * nearly * link.most * link.most) long_.push_back(link);
            }
        }
        bool moves = false;
        // Forwards and backwards, so that a correction spreads in both directions.
        for (std::size_t k = 0; k < long_.size(); ++k)
            if (project(long_[turn % 2 == 0 ? k : long_.size() - 1 - k], relaxationOf(turn))) moves = true;
        if (!moves && isOfAll) break;
        if (!moves) left = 1;  // look at all of them next
        any = any || moves;
    }
    return any;
}

bool StrainLimit::projectPositions(const Moment& moment) {
    return takeTurns(
        moment.x, turnsOfPlaces,
        [&](const Link& link, double relaxation) {
            const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
            const dvec3 d = moment.x[b] - moment.x[a];
            const double bearable = (1.0 + margin) * link.most;
            if (!(glm::dot(d, d) > bearable * bearable)) return false;
            const dvec3 before = moment.from[b] - moment.from[a];
            const double length = sizeOf(d), was = sizeOf(before),
                         weight = moment.inverseMass[a] + moment.inverseMass[b],
                         most = moment.isOfStep ? std::max(link.most, was) : link.most;
            if (!(length > most) || !(weight > 0)) return false;
            const bool isStraight = glm::dot(before, d) > straight * was * length;
            const dvec3 impulse = relaxation * (length - most) / weight * (isStraight ? before / was : d / length);
            moment.x[a] += moment.inverseMass[a] * impulse;
            moment.x[b] -= moment.inverseMass[b] * impulse;
            return true;
        });
}

bool StrainLimit::projectVelocities(const Moment& moment) {
    return takeTurns(
        moment.x, turnsOfVelocities,
        [&](const Link& link, double relaxation) {
            const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
            const dvec3 d = moment.x[b] - moment.x[a];
            const double square = glm::dot(d, d), weight = moment.inverseMass[a] + moment.inverseMass[b];
            if (!(square > link.most * link.most) || !(weight > 0)) return false;
            const dvec3 along = d / std::sqrt(square);
            const double speed = glm::dot(along, moment.v[b] - moment.v[a]);
            if (!(speed > settledSpeed * (sizeOf(moment.v[a]) + sizeOf(moment.v[b])))) return false;
            const dvec3 impulse = relaxation * speed / weight * along;
            moment.v[a] += moment.inverseMass[a] * impulse;
            moment.v[b] -= moment.inverseMass[b] * impulse;
            return true;
        });
}

}  // namespace taut::world
