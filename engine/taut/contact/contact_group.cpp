#include "taut/contact/contact_group.h"

#include <algorithm>
#include <cmath>

#include "taut/contact/certificate.h"
#include "taut/contact/closest_points.h"
#include "taut/contact/rigid_side.h"

namespace taut::contact {
namespace {

constexpr int mostSlides = 8, mostZones = 12;
constexpr double apartSpeed = 0.3;  // [m/s] that crossings are led apart with

// Each once; mostly they are so already.
void makeAscending(std::vector<int>& points) {
    if (std::adjacent_find(points.begin(), points.end(), std::greater_equal<>()) == points.end()) return;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

void addYielding(const Elements& elements, const ContactConstraint& pair, std::span<const double> inverseMass,
                 std::vector<int>& surfaces) {
    for (int i : pair.points)
        if (inverseMass[static_cast<std::size_t>(i)] > 0) surfaces.push_back(elements.surfaceOf(i));
}

}  // namespace

ContactGroup::ContactGroup(std::vector<Surface> surfaces, std::vector<dvec3> rest, const ContactOptions& options)
    : options_(options), elements_(std::move(surfaces), std::move(rest)), broadPhase_(elements_) {
    const auto count = static_cast<std::size_t>(elements_.pointCount());
    u0_.resize(count);
    u_.resize(count);
    v_.resize(count);
    shift_.resize(count);
    xIs_.resize(count);
    marks_.assign(count, unmarked);
}

void ContactGroup::drop() {
    broadPhase_.drop();
    active_.clear();
}

void ContactGroup::goBack(std::span<const dvec3> from, std::span<const dvec3> to) {
    broadPhase_.go(from, to);
}

void ContactGroup::begin(std::span<const dvec3> x) {
    for (const Crossing& crossing : crossings_)
        for (int i : crossing.points) marks_[static_cast<std::size_t>(i)] = unmarked;
    crossings_.clear();
    crossings_ = crossingsAt(x);
    if (!options_.untangles) return;
    for (const Crossing& crossing : crossings_)
        for (std::size_t k = 0; k < 5; ++k) {
            char& mark = marks_[static_cast<std::size_t>(crossing.points[k])];
            mark = std::max<char>(mark, crossing.areThrough[k] ? wrongSide : anySide);
        }
}

std::vector<Crossing> ContactGroup::crossingsAt(std::span<const dvec3> x) {
    return findCrossings(elements_, broadPhase_.bvh(), x);
}

Forecast ContactGroup::forecast(std::span<const dvec3> x, std::span<const dvec3> v, std::span<const double> inverseMass,
                                double seconds) {
    for (std::size_t i = 0; i < x.size(); ++i) xIs_[i] = x[i] + seconds * v[i];
    broadPhase_.find(x, xIs_);
    runNarrowPhase(x, xIs_);
    Forecast outlook;
    outlook.leastThickness = 1e300;
    Bvh& leaves = broadPhase_.bvh();
    leaves.followAll(x, xIs_);
    int moving = 0;
    for (int p = 0; p < leaves.count(); ++p) {
        const Surface& surface = elements_.surface(leaves[p].surface);
        if (surface.isRigid) continue;
        outlook.stir += 2 * leaves.motion(p).stray / surface.thickness;
        ++moving;
    }
    if (moving > 0) outlook.stir /= moving * seconds;
    for (const ContactConstraint& pair : contacts_) {
        if (!pair.isActive) continue;
        outlook.meets = true;
        dvec3 speed(0.0);
        for (std::size_t k = 0; k < 4; ++k) speed += pair.weights[k] * v[static_cast<std::size_t>(pair.points[k])];
        outlook.closing = std::max(outlook.closing, -glm::dot(pair.normal, speed));
        outlook.leastThickness = std::min(outlook.leastThickness, pair.thickness);
        addYielding(elements_, pair, inverseMass, outlook.surfaces);
    }
    makeAscending(outlook.surfaces);
    outlook.meets = outlook.meets || !crossings_.empty();
    return outlook;
}

const InstantResult& ContactGroup::resolve(const Instant& instant) {
    result_ = {};
    moved_.clear();
    std::copy(instant.x1.begin(), instant.x1.end(), xIs_.begin());
    broadPhase_.find(instant.x0, instant.x1);
    runNarrowPhase(instant.x0, instant.x1);
    active_.clear();
    for (const ContactConstraint& pair : contacts_) {
        if (!pair.isActive || !mayYield(pair, instant.inverseMass)) continue;
        active_.push_back(pair);
        dvec3 way(0.0);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(pair.points[k]);
            way += pair.weights[k] * (instant.x1[i] - instant.x0[i]);
        }
        const double deep = -std::max(pair.gap(), 0.0) - glm::dot(pair.normal, way);
        result_.deepest = std::max(result_.deepest, deep / pair.thickness);
    }
    if (!active_.empty() || !crossings_.empty()) press(instant);
    if (options_.certifies) certify(instant);
    makeAscending(moved_);
    broadPhase_.arrive(moved_, instant.x0, instant.x1);
    result_.moved = moved_;
    return result_;
}

// Points (ascending) have been moved.
void ContactGroup::handOver(const Instant& instant, std::span<const int> points) {
    moved_.insert(moved_.end(), points.begin(), points.end());
    if (instant.take) instant.take(points);
}

void ContactGroup::press(const Instant& instant) {
    // Only of points that may be pressed; the others are not asked for.
    const auto prepare = [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        u0_[k] = u_[k] = (instant.x1[k] - instant.x0[k]) / instant.h;
        v_[k] = instant.v[k];
        shift_[k] = dvec3(0.0);
    };
    for (const ContactConstraint& pair : active_)
        for (int i : pair.points) prepare(i);
    for (const Crossing& crossing : crossings_)
        for (int i : crossing.points) prepare(i);
    solver_.solve(active_, instant.held, instant.inverseMass, instant.h, options_.solver, u_, v_, shift_);
    for (std::size_t p = 0; p < active_.size(); ++p) {
        if (!(solver_.impulses()[p] > 0)) continue;
        ++result_.active;
        addYielding(elements_, active_[p], instant.inverseMass, result_.surfaces);
    }
    makeAscending(result_.surfaces);
    result_.sweeps = solver_.sweeps();
    if (options_.untangles) untangle(instant);

    std::vector<int> moved;
    const auto take = [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        if (!(instant.inverseMass[k] > 0)) return;
        if (u_[k] == u0_[k] && v_[k] == instant.v[k] && shift_[k] == dvec3(0.0)) return;
        instant.x1[k] += instant.h * (u_[k] - u0_[k]) + shift_[k];
        instant.v[k] = v_[k];
        u0_[k] = u_[k];
        shift_[k] = dvec3(0.0);
        moved.push_back(i);
    };
    for (int i : solver_.points()) take(i);
    for (const Crossing& crossing : crossings_)
        for (int i : crossing.points) take(i);
    if (moved.empty()) return;
    makeAscending(moved);
    handOver(instant, moved);
}

void ContactGroup::untangle(const Instant& instant) {
    for (const Crossing& crossing : crossings_) {
        double inverse = 0, speed = 0, speedV = 0, most = 0;
        for (std::size_t k = 0; k < 5; ++k) {
            const auto i = static_cast<std::size_t>(crossing.points[k]);
            inverse += crossing.weights[k] * crossing.weights[k] * instant.inverseMass[i];
            most = std::max(most, std::abs(crossing.weights[k]) * instant.inverseMass[i]);
            speed += crossing.weights[k] * glm::dot(u_[i], crossing.apart);
            speedV += crossing.weights[k] * glm::dot(v_[i], crossing.apart);
        }
        if (!(inverse > 0) || crossing.apart == dvec3(0.0)) continue;
        if (!mayYield(crossing, instant.inverseMass)) continue;
        // No more than from rest, whatever comes against it, and no point faster than that, whatever lever it is on: a
        // pinch is held until it opens.
        const auto impulseAgainst = [&](double before) {
            return std::min(std::clamp(apartSpeed - before, 0.0, apartSpeed) / inverse, apartSpeed / most);
        };
        const double impulse = impulseAgainst(speed), impulseV = impulseAgainst(speedV);
        for (std::size_t k = 0; k < 5; ++k) {
            const auto i = static_cast<std::size_t>(crossing.points[k]);
            const double share = crossing.weights[k] * instant.inverseMass[i];
            u_[i] += (share * impulse) * crossing.apart;
            v_[i] += (share * impulseV) * crossing.apart;
        }
    }
}

std::vector<const ContactConstraint*> ContactGroup::uncertified(const Instant& instant) const {
    std::vector<const ContactConstraint*> bad;
    for (const ContactConstraint& pair : contacts_)
        if (!isCertified(pair, instant.x0, instant.x1)) bad.push_back(&pair);
    return bad;
}

// Points went elsewhere than the near pairs were found for; only where that may have brought others near.
void ContactGroup::findAgain(const Instant& instant, std::span<const int> moved) {
    double most = 0;
    for (int i : moved) {
        const dvec3 d = instant.x1[static_cast<std::size_t>(i)] - xIs_[static_cast<std::size_t>(i)];
        most = std::max(most, glm::dot(d, d));
    }
    if (broadPhase_.holdWithin(std::sqrt(most))) return;
    broadPhase_.find(instant.x0, instant.x1);
    runNarrowPhase(instant.x0, instant.x1);
    std::copy(instant.x1.begin(), instant.x1.end(), xIs_.begin());
}

void ContactGroup::certify(const Instant& instant) {
    if (!moved_.empty()) findAgain(instant, moved_);
    for (int round = 0; round < mostSlides + mostZones; ++round) {
        const std::vector<const ContactConstraint*> bad = uncertified(instant);
        result_.uncertified = static_cast<int>(bad.size());
        if (bad.empty()) return;
        std::vector<int> moved;
        if (round < mostSlides && options_.slides) {
            for (const ContactConstraint* pair : bad)
                slideApart(*pair, instant.inverseMass, instant.held, instant.x1, instant.v, moved);
            result_.slides += static_cast<int>(bad.size());
        } else {
            moveAsImpactZones(bad, instant.inverseMass, instant.h, instant.x0, instant.x1, instant.v, moved);
            ++result_.zones;
        }
        if (moved.empty()) break;
        makeAscending(moved);
        handOver(instant, moved);
        findAgain(instant, moved_);
    }
    result_.uncertified = static_cast<int>(uncertified(instant).size());
}

std::vector<ContactPoint> ContactGroup::contactPoints(std::span<const dvec3> x) const {
    std::vector<ContactPoint> all;
    for (std::size_t p = 0; p < active_.size(); ++p) {
        const ContactConstraint& pair = active_[p];
        const double impulse = p < solver_.impulses().size() ? solver_.impulses()[p] : 0.0;
        if (!(impulse > 0)) continue;
        dvec3 first(0.0), second(0.0);
        for (int k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(k);
            (k < pair.firstSide() ? first : second) += pair.weights[i] * x[static_cast<std::size_t>(pair.points[i])];
        }
        all.push_back({0.5 * (first - second), pair.normal, impulse, elements_.surfaceOf(pair.points[0]),
                       elements_.surfaceOf(pair.points[3])});
    }
    return all;
}

std::uint64_t ContactGroup::bytes() const {
    return elements_.bytes() + broadPhase_.bytes() + contacts_.capacity() * sizeof(ContactConstraint) +
           xIs_.size() * 5 * sizeof(dvec3);
}

double distanceBetween(const Elements& elements, Bvh& leaves, std::span<const dvec3> x,
                       const std::function<bool(int surface)>& isFirst,
                       const std::function<bool(int surface)>& isSecond) {
    leaves.start(x, x);
    leaves.followAll(x, x);
    const auto at = [&](int i) -> const dvec3& { return x[static_cast<std::size_t>(i)]; };
    double least = 1e300;
    // Calls each(a, b) for leaves of both sides whose boxes are nearer than the least so far.
    const auto forEachNear = [&](auto&& each) {
        for (int a = 0; a < leaves.count(); ++a) {
            if (!isFirst(leaves[a].surface)) continue;
            for (int b = 0; b < leaves.count(); ++b) {
                if (!isSecond(leaves[b].surface)) continue;
                const Box &p = leaves.motion(a).box, &q = leaves.motion(b).box;
                const dvec3 gap = glm::max(dvec3(0.0), glm::max(p.low - q.high, q.low - p.high));
                const double bound = glm::dot(gap, gap);
                if (bound < least) each(a, b, bound);
            }
        }
    };
    const auto points = [&](const BvhLeaf& of, const BvhLeaf& triangles) {
        for (int i : of.points)
            for (int t : triangles.triangles) {
                const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(t)];
                const std::array<int, 3>& c = triangle.points;
                if (triangle.isGone || i == c[0] || i == c[1] || i == c[2]) continue;
                const OnTriangle on = closestOnTriangle(at(i), at(c[0]), at(c[1]), at(c[2]));
                const dvec3 d =
                    at(i) - (on.weights[0] * at(c[0]) + on.weights[1] * at(c[1]) + on.weights[2] * at(c[2]));
                least = std::min(least, glm::dot(d, d));
            }
    };
    const auto measure = [&](int first, int second) {
        const BvhLeaf &a = leaves[first], &b = leaves[second];
        points(a, b);
        points(b, a);
        for (int e : a.edges)
            for (int f : b.edges) {
                const Edge &own = elements.edges()[static_cast<std::size_t>(e)],
                           &other = elements.edges()[static_cast<std::size_t>(f)];
                if (own.isGone || other.isGone) continue;
                const OnSegments on = closestOnSegments(at(own.a), at(own.b), at(other.a), at(other.b));
                const dvec3 d =
                    at(own.a) + on.s * (at(own.b) - at(own.a)) - (at(other.a) + on.t * (at(other.b) - at(other.a)));
                least = std::min(least, glm::dot(d, d));
            }
    };
    // The two that are nearest by their boxes, and then what may be nearer still.
    int first = -1, second = -1;
    double nearest = 1e300;
    forEachNear([&](int a, int b, double bound) {
        if (first >= 0 && !(bound < nearest)) return;
        nearest = bound;
        first = a;
        second = b;
    });
    if (first >= 0) measure(first, second);
    forEachNear([&](int a, int b, double) { measure(a, b); });
    return std::sqrt(least);
}

}  // namespace taut::contact
