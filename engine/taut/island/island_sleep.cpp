// How an island comes to rest, sleeps and wakes. The world decides which islands sleep together.
#include <algorithm>
#include <array>
#include <cmath>

#include "taut/core/private/hash.h"
#include "taut/island/private/island.h"
#include "taut/island/private/rest_bound.h"
#include "taut/plan/held_pair.h"

namespace taut::world {
namespace {

constexpr double stillShare = 0.01;    // of the error: how far a point may go in a window that friction holds
constexpr double holdingShare = 0.98;  // of Coulomb's limit: up to there all friction of a solid holds it

// (points) The places of points that constraints hold in one place with others, as weighted sums of the remaining
// points; empty if constraints do anything else.
std::vector<std::vector<Spot::Share>> leadersOf(const IslandPlan& plan, double t) {
    std::vector<std::vector<Spot::Share>> leaders;
    for (int i = 0; i < static_cast<int>(plan.points.size()); ++i) leaders.push_back({{i, 1.0}});
    for (const auto& constraint : plan.constraints) {
        const auto pairs = constraint->joinedFrom(t);
        if (!pairs) return {};
        const auto numberOf = [&](int end) { return static_cast<std::size_t>(constraint->points()[end]); };
        for (const Constraint::Pair& pair : *pairs) {
            std::vector<Spot::Share> sum;
            for (const auto& [b, weight] : pair.b.shares())
                for (const auto& [leader, own] : leaders[numberOf(b)]) sum.push_back({leader, weight * own});
            leaders[numberOf(pair.a.nearest())] = std::move(sum);
        }
    }
    return leaders;
}

// Whether a rigid body stays: the places where it is pressed or pinned are not on one line, or a contact resists
// rolling, which keeps it from tipping; and two pins that are apart, or all its friction, keep it from sliding.
// Distances are held against the size of the body, x (its points) [m].
bool staysPut(std::span<const Island::Foothold> footholds, std::span<const dvec3> pins, std::span<const dvec3> x) {
    constexpr double leastShare = 0.05;
    double size = 0, friction = 0, limit = 0;
    for (const dvec3& p : x) size = std::max(size, glm::distance(p, x[0]));
    std::vector<dvec3> places(pins.begin(), pins.end());
    bool resistsRolling = false;
    for (const Island::Foothold& own : footholds) {
        places.push_back(own.place);
        friction += own.friction;
        limit += own.limit;
        resistsRolling = resistsRolling || own.resistsRolling;
    }
    const auto lengthAndWidth = [](std::span<const dvec3> of) {
        double length = 0, width = 0;
        dvec3 line(0.0);  // from the first
        for (const dvec3& place : of)
            if (const dvec3 way = place - of[0]; glm::length(way) > length)
                length = glm::length(way), line = way / length;
        for (const dvec3& place : of) width = std::max(width, glm::length(glm::cross(line, place - of[0])));
        return std::pair(length, width);
    };
    const bool isUpright = resistsRolling || lengthAndWidth(places).second > leastShare * size;
    return isUpright &&
           (lengthAndWidth(pins).first > leastShare * size || (limit > 0 && friction <= holdingShare * limit));
}

// Whether all bodies of an island are solids that stay: each is pressed, or pinned to a place that stays, where it has
// to be. x (points) [m].
bool allStayPut(const IslandPlan& plan, double t, std::span<const HeldPair> pairs,
                std::span<const Island::Foothold> footholds, std::span<const dvec3> x) {
    constexpr double tautFrom = 1.0 - 1e-9;  // of the length of a leash
    const std::vector<bool> isHeld = heldPointsOf(plan);
    std::vector<int> solidOf(plan.points.size(), -1);
    std::vector<std::vector<dvec3>> points(plan.solids.size()), heldAt = points;
    for (std::size_t s = 0; s < plan.solids.size(); ++s)
        for (const Body* body : plan.solids[s])
            for (const int point : body->pointOf) {
                solidOf[point] = static_cast<int>(s);
                points[s].push_back(x[point]);
                if (isHeld[point]) heldAt[s].push_back(points[s].back());
            }
    if (std::count(solidOf.begin(), solidOf.end(), -1) > 0) return false;
    // Pairs that are one, or as far apart as they may be: the solid at either end, none for a collider.
    struct Pin {
        std::array<int, 2> solids;
        dvec3 place;
    };
    std::vector<Pin> pins;
    const auto solidAt = [&](const HeldPair::End& end) { return end.place != nullptr ? -1 : solidOf[end.point()]; };
    for (const HeldPair& pair : pairs)
        if ((pair.length == 0 && !pair.line) ||
            (pair.isMost && glm::distance(pair.a.at(plan, x, t), pair.b.at(plan, x, t)) > tautFrom * pair.length))
            pins.push_back({{solidAt(pair.a), solidAt(pair.b)}, pair.a.at(plan, x, t)});
    std::vector<bool> stays(plan.solids.size(), false);
    for (bool isAny = true; isAny;) {
        isAny = false;
        for (std::size_t s = 0; s < stays.size(); ++s) {
            if (stays[s]) continue;
            std::vector<Island::Foothold> pressed;
            for (const Island::Foothold& foothold : footholds)
                if (std::count(plan.solids[s].begin(), plan.solids[s].end(), foothold.body) > 0)
                    pressed.push_back(foothold);
            std::vector<dvec3> held = heldAt[s];
            for (const auto& [ends, place] : pins)
                for (const std::size_t own : {std::size_t{0}, std::size_t{1}})
                    if (const int other = ends[1 - own];
                        ends[own] == static_cast<int>(s) && (other < 0 || stays[other]))
                        held.push_back(place);
            stays[s] = staysPut(pressed, held, points[s]);
            isAny = isAny || stays[s];
        }
    }
    return std::count(stays.begin(), stays.end(), false) == 0;
}

}  // namespace

void Island::beginRestWindow(std::int64_t number) {
    dynamics_->positions(x_);
    rest_.begin(number, x_);
}

void Island::watchRest(bool isMiddle) {
    if (!rest_.isWatching()) return;
    dynamics_->positions(x_);
    rest_.look(x_, plan_.solver.sleepError / 3, isMiddle);
}

// Islands moved by a hand or a collider stay awake.
bool Island::isCalm() {
    const auto moves = [](const auto& holder) { return holder.path.moves(); };
    return rest_.isCalm() && now_.inside.empty() && !isOpen_ &&
           std::none_of(plan_.grips.begin(), plan_.grips.end(), moves) &&
           std::none_of(plan_.carriers.begin(), plan_.carriers.end(), moves) && dynamics_->isSteady(forces_);
}

// Points that constraints hold in one place move as one. Points that they hold otherwise have no stiffness, so they
// stay awake, but for solids that stay where they are, and for joined solids whose motion dies out: of a lamp on its
// chain, which friction, damping or drag bring to rest. If it were about to tip, the motion would grow.
bool Island::rests(double t, double seconds, std::vector<Support> supports, std::span<const Foothold> footholds) {
    const double error = plan_.solver.sleepError, still = stillShare * error / seconds;
    const std::size_t n = plan_.points.size();
    dynamics_->positions(x_);
    if (!plan_.solids.empty()) {
        for (std::size_t i = 0; i < n; ++i)
            if (const dvec3 v = rest_.velocity(i, x_[i], seconds); !(glm::dot(v, v) <= still * still)) return false;
        if (allStayPut(plan_, t, dynamics_->heldPairs(t), footholds, x_)) return true;
        const bool areSolids = std::all_of(plan_.bodies.begin(), plan_.bodies.end(),
                                           [](const Body* body) { return body->spec->isRigid(); });
        return areSolids && plan_.constraints.size() > plan_.solids.size() &&
               rest_.wayLeft(x_, stillShare * error) <= error / 3;
    }
    const auto leaders = leadersOf(plan_, t);
    if (leaders.empty()) return false;
    supports.resize(n);
    for (const collision::Contact& contact : now_.contacts) {
        Support& support = supports[contact.point];
        support.mayStick = (support.push == dvec3(0.0) || support.mayStick) && contact.friction > 0;
        support.push = contact.normal;
    }
    std::vector<dvec3> v(n), r(n), normals(n, dvec3(0.0));
    std::vector<double> inverseMasses = inverseMassesOf(plan_);
    const std::vector<bool> isHeld = heldPointsOf(plan_);
    for (std::size_t i = 0; i < n; ++i) {
        const mechanics::PointMass& point = plan_.points[i];
        v[i] = rest_.velocity(i, x_[i], seconds);
        r[i] = point.mass * (rest_.acceleration(i, x_[i], seconds) + point.dragRate * v[i]);
        const bool sticks = supports[i].mayStick && glm::dot(v[i], v[i]) <= still * still;
        if (isHeld[i] || !isFree(plan_, static_cast<int>(i)) || sticks) inverseMasses[i] = 0;
        const double push = std::sqrt(glm::dot(supports[i].push, supports[i].push));
        if (push > 0) normals[i] = supports[i].push / push;
    }
    // Leaders stand for all that are in their place, or between them.
    for (std::size_t i = 0; i < n; ++i) {
        if (leaders[i].size() == 1 && leaders[i].front().point == static_cast<int>(i)) continue;
        for (const auto& [point, weight] : leaders[i]) {
            const auto leader = static_cast<std::size_t>(point);
            double& inverse = inverseMasses[leader];
            inverse = inverse > 0 && inverseMasses[i] > 0 ? 1.0 / (1.0 / inverse + weight / inverseMasses[i]) : 0.0;
            r[leader] += weight * r[i];
            if (normals[leader] == dvec3(0.0)) normals[leader] = normals[i];
        }
        inverseMasses[i] = 0;
    }
    std::vector<dvec3> ways(n), forces(n);
    const mechanics::StiffnessProduct stiffness = stiffnessAt(x_);
    const auto ofLeaders = [&](std::span<const dvec3> in, std::span<dvec3> sum) {
        for (std::size_t i = 0; i < n; ++i) {
            ways[i] = dvec3(0.0);
            for (const auto& [leader, weight] : leaders[i]) ways[i] += weight * in[leader];
        }
        std::fill(forces.begin(), forces.end(), dvec3(0.0));
        stiffness(ways, forces);
        for (std::size_t i = 0; i < n; ++i)
            for (const auto& [leader, weight] : leaders[i]) sum[leader] += weight * forces[i];
    };
    return restBound(inverseMasses, normals, v, r, still, ofLeaders) <= error / 3;
}

void Island::fallAsleep(const TickTime& time, std::int64_t company) {
    open(time);
    const std::vector<dvec3> v = dynamics_->velocities();
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (isFree(plan_, static_cast<int>(i))) {
            const double m = plan_.points[i].mass;
            sleep_.taken.energy += 0.5 * m * glm::dot(v[i], v[i]);
            sleep_.taken.momentum += m * v[i];
        }
        dynamics_->setVelocity(static_cast<int>(i), dvec3(0.0));
    }
    isOpen_ = false;
    now_.pressed.clear();
    rest_.stop();
    rest_.forgive();
    sleep_.company = company;
}

void Island::wake() {
    sleep_.company = 0;
    sleep_.box.reset();
    sleep_.hashes.clear();
    isOpen_ = true;
}

bool Island::isReachedBy(std::span<const ColliderMotion> moving) {
    if (!mayCollide_ || moving.empty()) return false;
    if (!sleep_.box) {
        sleep_.box.emplace();
        for (int i = 0; i < static_cast<int>(plan_.points.size()); ++i) sleep_.box->add(position(i));
        double thickness = 0;
        for (const Body* body : plan_.bodies) thickness = std::max(thickness, body->spec->thickness);
        sleep_.box->grow(2 * thickness + plan_.solver.sleepError);
    }
    bool isReached = false;
    for (const ColliderMotion& m : moving)
        for (const collision::Pose& start : {m.from, m.to}) {
            // At its start, then on its way: a collider that jumps has no way.
            colliders_.move(m.collider, m.from, start);
            isReached = isReached || colliders_.isNear(m.collider, *sleep_.box);
        }
    return isReached;
}

std::uint64_t Island::hashAsleep(const Body& body) {
    for (const auto& [known, hash] : sleep_.hashes)
        if (known == &body) return hash;
    core::Hash hash;
    addToHash(body, hash);
    sleep_.hashes.emplace_back(&body, hash.value());
    return hash.value();
}

}  // namespace taut::world
