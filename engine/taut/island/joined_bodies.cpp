#include "taut/island/private/joined_bodies.h"

#include <algorithm>
#include <cmath>

namespace taut::world {
namespace {

using glm::dvec3;

constexpr double tautFrom = 1.0 - 1e-9;  // of the length of a leash

double sumOf(std::span<const dvec3> a, std::span<const dvec3> b, std::span<const double> over) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += over[k] > 0 ? glm::dot(a[k], b[k]) / over[k] : 0.0;
    return sum;
}

}  // namespace

void JoinedBodies::begin(std::size_t points) {
    bodies_.clear();
    pairs_.clear();
    bodyOf_.assign(points, -1);
}

void JoinedBodies::addBody(const core::RigidMotion& body, std::span<const std::size_t> points) {
    for (const std::size_t point : points)
        if (bodyOf_[point] < 0) bodyOf_[point] = static_cast<int>(bodies_.size());
    bodies_.push_back(body);
}

Spot JoinedBodies::footOf(const Line& line, const Spot& b, std::span<const dvec3> x) {
    const dvec3 low = line[0].of(x), way = line[1].of(x) - low;
    const double share = glm::dot(b.of(x) - low, way) / glm::dot(way, way);
    std::array<Spot::Share, 4> shares{};  // both spots are of the same points, or each is one
    std::size_t count = 0;
    for (const auto& [spot, part] : {std::pair(&line[0], 1.0 - share), std::pair(&line[1], share)})
        for (const auto& [point, weight] : spot->shares()) {
            const auto same = std::find_if(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(count),
                                           [&, own = point](const Spot::Share& other) { return other.point == own; });
            if (same == shares.begin() + static_cast<std::ptrdiff_t>(count)) shares[count++] = {point, 0.0};
            same->weight += part * weight;
        }
    return Spot(std::span(shares).first(count));
}

void JoinedBodies::addSliding(const Line& line, const Spot& b, std::size_t pull, std::span<const dvec3> x) {
    pairs_.push_back({footOf(line, b, x), b, pull, 0.0, false, line, glm::normalize(line[1].of(x) - line[0].of(x))});
}

dvec3 JoinedBodies::Pair::open(std::span<const dvec3> values, bool arePlaces) const {
    if (!line || !arePlaces) return b.of(values) - a.of(values);
    const dvec3 low = (*line)[0].of(values), along = glm::normalize((*line)[1].of(values) - low),
                between = b.of(values) - low;
    return between - glm::dot(between, along) * along;
}

// The part of a difference that a pair rules.
dvec3 JoinedBodies::held(std::size_t pair, const dvec3& difference) const {
    if (pairs_[pair].length > 0) return glm::dot(difference, along_[pair]) * along_[pair];
    dvec3 left = difference;
    for (const dvec3& given : given_[pair]) left -= glm::dot(left, given) * given;
    return left;
}

// Of pairs between two bodies, or between one and places that nothing moves.
void JoinedBodies::findGiven(std::span<const dvec3> at, std::span<const double> inverseMass) {
    constexpr double least = 1e-6;  // [m]
    constexpr int loose = -2;
    given_.assign(pairs_.size(), {dvec3(0.0), dvec3(0.0)});
    const auto bodyAt = [&](const Spot& end) {
        const auto point = static_cast<std::size_t>(end.nearest());
        return bodyOf_[point] < 0 && inverseMass[point] > 0 ? loose : bodyOf_[point];
    };
    std::vector<std::pair<std::array<int, 2>, std::size_t>> earlier;  // bodies, pair
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        const std::array<int, 2> bodies{bodyAt(pairs_[k].a), bodyAt(pairs_[k].b)};
        auto next = given_[k].begin();
        if (pairs_[k].line) *next++ = pairs_[k].free;
        if (pairs_[k].length > 0 || bodies[0] == loose || bodies[1] == loose) continue;
        for (const auto& [others, other] : earlier) {
            if (others != bodies || next == given_[k].end()) continue;
            const dvec3 way = held(k, pairs_[k].a.of(at) - pairs_[other].a.of(at));
            const double size = std::sqrt(glm::dot(way, way));
            if (size > least) *next++ = way / size;
        }
        earlier.emplace_back(bodies, k);
    }
}

bool JoinedBodies::isEmpty() const {
    const auto isOfBody = [&](const Spot& end) {
        return std::any_of(
            end.shares().begin(), end.shares().end(), [&](const Spot::Share& own) { return bodyOf_[own.point] >= 0; });
    };
    return std::none_of(pairs_.begin(), pairs_.end(),
                        [&](const Pair& pair) { return isOfBody(pair.a) || isOfBody(pair.b); });
}

// moved_ = A way_
void JoinedBodies::respond(std::span<const dvec3> at, std::span<const double> inverseMass) {
    sum_.assign(bodies_.size(), dvec3(0.0));
    turn_.assign(bodies_.size(), dvec3(0.0));
    for (const Pair& pair : pairs_)
        for (const Spot* end : {&pair.a, &pair.b})
            for (const Spot::Share& own : end->shares()) force_[own.point] = dvec3(0.0);
    const auto pushPoint = [&](std::size_t point, const dvec3& impulse) {
        if (!(inverseMass[point] > 0)) return;
        force_[point] += impulse;
        if (bodyOf_[point] < 0) return;
        const auto k = static_cast<std::size_t>(bodyOf_[point]);
        sum_[k] += impulse;
        turn_[k] += glm::cross(at[point] - bodies_[k].centre, impulse);
    };
    const auto push = [&](const Spot& end, const dvec3& impulse) {
        for (const auto& [point, weight] : end.shares()) pushPoint(static_cast<std::size_t>(point), weight * impulse);
    };
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        push(pairs_[k].a, way_[k]);
        push(pairs_[k].b, -way_[k]);
    }
    for (std::size_t k = 0; k < bodies_.size(); ++k) turn_[k] = bodies_[k].inverseInertia * turn_[k];
    const auto pointMoved = [&](std::size_t point) {
        if (!(inverseMass[point] > 0)) return dvec3(0.0);
        if (bodyOf_[point] < 0) return inverseMass[point] * force_[point];
        const auto k = static_cast<std::size_t>(bodyOf_[point]);
        return sum_[k] / bodies_[k].mass + glm::cross(turn_[k], at[point] - bodies_[k].centre);
    };
    const auto moved = [&](const Spot& end) {
        dvec3 sum(0.0);
        for (const auto& [point, weight] : end.shares()) sum += weight * pointMoved(static_cast<std::size_t>(point));
        return sum;
    };
    for (std::size_t k = 0; k < pairs_.size(); ++k) moved_[k] = held(k, moved(pairs_[k].a) - moved(pairs_[k].b));
}

// Leashes only pull: those whose impulse would push go slack, and the solution is repeated.
bool JoinedBodies::solve(std::span<const dvec3> at, std::span<const double> inverseMass, std::span<const dvec3> values,
                         bool arePlaces, double settled) {
    isSlack_.assign(pairs_.size(), false);
    while (solveTaut(at, inverseMass, values, arePlaces, settled)) {
        bool isAny = false;
        for (std::size_t k = 0; k < pairs_.size(); ++k)
            if (pairs_[k].isMost && !isSlack_[k] && tension(k) < 0.0) isSlack_[k] = isAny = true;
        if (!isAny) return true;
    }
    return false;
}

bool JoinedBodies::solveTaut(std::span<const dvec3> at, std::span<const double> inverseMass,
                             std::span<const dvec3> values, bool arePlaces, double settled) {
    // Redundant constraints, such as some rods, agree to second order only. Solves end there.
    constexpr double exactly = 1e-4;
    // Share of the response of single pairs. n links in a row, held at both ends only, have 1/n².
    constexpr double leastResponse = 1e-6;
    const std::size_t count = pairs_.size();
    p_.assign(count, dvec3(0.0));
    left_.resize(count);
    moved_.resize(count);
    ease_.resize(count);
    force_.assign(bodyOf_.size(), dvec3(0.0));
    const auto easeOf = [&](const Spot& end) {
        const auto point = static_cast<std::size_t>(end.nearest());
        if (bodyOf_[point] < 0) return end.ease(inverseMass);
        if (!(inverseMass[point] > 0)) return 0.0;
        const core::RigidMotion& body = bodies_[bodyOf_[point]];
        const dvec3 arm = end.of(at) - body.centre;
        const glm::dmat3& i = body.inverseInertia;
        return 1.0 / body.mass + glm::dot(arm, arm) * (i[0][0] + i[1][1] + i[2][2]) / 3.0;
    };
    along_.assign(count, dvec3(0.0));
    findGiven(at, inverseMass);
    double furthest = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const Pair& pair = pairs_[k];
        left_[k] = pair.open(values, arePlaces);
        if (pair.length > 0) {
            const dvec3 between = pair.a.of(at) - pair.b.of(at);
            const double size = std::sqrt(glm::dot(between, between));
            along_[k] = size > 0 ? between / size : dvec3(1.0, 0.0, 0.0);
            const double square = glm::dot(left_[k], left_[k]), length = pair.length;
            if (pair.isMost && (arePlaces ? !(square > length * length)
                                          : !(size > tautFrom * length) || !(glm::dot(left_[k], between) < 0.0)))
                isSlack_[k] = true;
            if (isSlack_[k]) along_[k] = dvec3(0.0);
            left_[k] = arePlaces ? (length * length - square) / (2.0 * length) * along_[k] : held(k, left_[k]);
        } else {
            left_[k] = held(k, left_[k]);
        }
        ease_[k] = easeOf(pair.a) + easeOf(pair.b);
        const dvec3 a = pair.a.of(values);
        const double size = 1.0 + std::sqrt(glm::dot(a, a));
        furthest = std::max(furthest, std::sqrt(glm::dot(left_[k], left_[k])) / size);
    }
    if (!(furthest > settled)) return false;

    way_.resize(count);
    for (std::size_t k = 0; k < count; ++k) way_[k] = ease_[k] > 0 ? left_[k] / ease_[k] : dvec3(0.0);
    double size = sumOf(left_, left_, ease_), least = size;
    const double wanted = exactly * exactly * size;
    best_ = p_;
    for (std::size_t round = 0; round < 3 * count + 10 && size > wanted; ++round) {
        respond(at, inverseMass);
        double along = 0;
        for (std::size_t k = 0; k < count; ++k) along += glm::dot(way_[k], moved_[k]);
        double eased = 0;  // `along` by the estimates, except for rods with demands that no motion satisfies
        for (std::size_t k = 0; k < count; ++k) eased += ease_[k] * glm::dot(way_[k], way_[k]);
        if (!(along > leastResponse * eased)) break;
        const double share = size / along;
        for (std::size_t k = 0; k < count; ++k) {
            p_[k] += share * way_[k];
            left_[k] -= share * moved_[k];
        }
        const double next = sumOf(left_, left_, ease_);
        for (std::size_t k = 0; k < count; ++k)
            way_[k] = (ease_[k] > 0 ? left_[k] / ease_[k] : dvec3(0.0)) + next / size * way_[k];
        size = next;
        if (size >= least) continue;
        least = size;
        best_ = p_;
    }
    p_ = best_;  // redundant pairs that cannot be satisfied make later iterates worse
    return true;
}

double JoinedBodies::turning(std::span<const dvec3> at, std::span<const double> forces) const {
    // [rad] in a step: of a turning body, of a body that swings on its joint, and of a spring.
    constexpr double mostTurn = 0.25, mostJoined = 0.025, mostSwing = 1.5;
    constexpr double joined = mostSwing * mostSwing / (mostJoined * mostJoined);
    std::vector<double> sum(bodies_.size(), 0.0);
    for (std::size_t k = 0; k < pairs_.size(); ++k)
        for (const Spot* end : {&pairs_[k].a, &pairs_[k].b}) {
            const int body = bodyOf_[end->nearest()];
            if (body < 0) continue;
            const auto own = static_cast<std::size_t>(body);
            const dvec3 arm = end->of(at) - bodies_[own].centre;
            const double length = std::sqrt(glm::dot(arm, arm));
            if (!(length > 0)) continue;
            const glm::dmat3& i = bodies_[own].inverseInertia;
            const dvec3 along = arm / length;
            sum[own] += forces[k] * length * (i[0][0] + i[1][1] + i[2][2] - glm::dot(along, i * along));
        }
    double most = 0;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const dvec3 rate = (mostSwing / mostTurn) * bodies_[k].spin;
        most = std::max({most, joined * sum[k], glm::dot(rate, rate)});
    }
    return most;
}

}  // namespace taut::world
