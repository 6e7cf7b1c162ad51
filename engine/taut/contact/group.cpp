#include "taut/contact/group.h"

#include <algorithm>
#include <cmath>

#include "taut/contact/closest.h"
#include "taut/contact/guard.h"
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

void addYielding(const Elements& elements, const MeetingPair& pair, std::span<const double> inverseMass,
                 std::vector<int>& surfaces) {
    for (int i : pair.points)
        if (inverseMass[static_cast<std::size_t>(i)] > 0) surfaces.push_back(elements.surfaceOf(i));
}

}  // namespace

Group::Group(std::vector<Surface> surfaces, std::vector<dvec3> rest, const GroupOptions& options)
    : options_(options), elements_(std::move(surfaces), std::move(rest)), near_(elements_) {
    const auto count = static_cast<std::size_t>(elements_.pointCount());
    u0_.resize(count);
    u_.resize(count);
    v_.resize(count);
    shift_.resize(count);
    xIs_.resize(count);
    marks_.assign(count, unmarked);
}

void Group::drop() {
    near_.drop();
    pressed_.clear();
}

void Group::goBack(std::span<const dvec3> from, std::span<const dvec3> to) {
    near_.go(from, to);
}

void Group::begin(std::span<const dvec3> x) {
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

std::vector<Crossing> Group::crossingsAt(std::span<const dvec3> x) {
    return findCrossings(elements_, near_.patches(), x);
}

Outlook Group::foresee(std::span<const dvec3> x, std::span<const dvec3> v, std::span<const double> inverseMass,
                       double seconds) {
    for (std::size_t i = 0; i < x.size(); ++i) xIs_[i] = x[i] + seconds * v[i];
    near_.find(x, xIs_);
    locate(x, xIs_);
    Outlook outlook;
    outlook.leastKeep = 1e300;
    Patches& patches = near_.patches();
    patches.followAll(x, xIs_);
    int moving = 0;
    for (int p = 0; p < patches.count(); ++p) {
        const Surface& surface = elements_.surface(patches[p].surface);
        if (surface.isRigid) continue;
        outlook.stir += 2 * patches.motion(p).stray / surface.thickness;
        ++moving;
    }
    if (moving > 0) outlook.stir /= moving * seconds;
    for (const MeetingPair& pair : pairs_) {
        if (!pair.presses) continue;
        outlook.meets = true;
        dvec3 speed(0.0);
        for (std::size_t k = 0; k < 4; ++k) speed += pair.weights[k] * v[static_cast<std::size_t>(pair.points[k])];
        outlook.closing = std::max(outlook.closing, -glm::dot(pair.normal, speed));
        outlook.leastKeep = std::min(outlook.leastKeep, pair.keep);
        addYielding(elements_, pair, inverseMass, outlook.surfaces);
    }
    makeAscending(outlook.surfaces);
    outlook.meets = outlook.meets || !crossings_.empty();
    return outlook;
}

const Meeting& Group::meet(const Instant& instant) {
    meeting_ = {};
    moved_.clear();
    std::copy(instant.x1.begin(), instant.x1.end(), xIs_.begin());
    near_.find(instant.x0, instant.x1);
    locate(instant.x0, instant.x1);
    pressed_.clear();
    for (const MeetingPair& pair : pairs_) {
        if (!pair.presses || !mayYield(pair, instant.inverseMass)) continue;
        pressed_.push_back(pair);
        dvec3 way(0.0);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(pair.points[k]);
            way += pair.weights[k] * (instant.x1[i] - instant.x0[i]);
        }
        const double deep = -std::max(pair.gap(), 0.0) - glm::dot(pair.normal, way);
        meeting_.deepest = std::max(meeting_.deepest, deep / pair.keep);
    }
    if (!pressed_.empty() || !crossings_.empty()) press(instant);
    if (options_.certifies) guard(instant);
    makeAscending(moved_);
    near_.arrive(moved_, instant.x0, instant.x1);
    meeting_.moved = moved_;
    return meeting_;
}

// Points (ascending) have been moved.
void Group::give(const Instant& instant, std::span<const int> points) {
    moved_.insert(moved_.end(), points.begin(), points.end());
    if (instant.take) instant.take(points);
}

void Group::press(const Instant& instant) {
    // Only of points that may be pressed; the others are not asked for.
    const auto prepare = [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        u0_[k] = u_[k] = (instant.x1[k] - instant.x0[k]) / instant.h;
        v_[k] = instant.v[k];
        shift_[k] = dvec3(0.0);
    };
    for (const MeetingPair& pair : pressed_)
        for (int i : pair.points) prepare(i);
    for (const Crossing& crossing : crossings_)
        for (int i : crossing.points) prepare(i);
    pressing_.solve(pressed_, instant.held, instant.inverseMass, instant.h, options_.pressing, u_, v_, shift_);
    for (std::size_t p = 0; p < pressed_.size(); ++p) {
        if (!(pressing_.impulses()[p] > 0)) continue;
        ++meeting_.pressing;
        addYielding(elements_, pressed_[p], instant.inverseMass, meeting_.surfaces);
    }
    makeAscending(meeting_.surfaces);
    meeting_.sweeps = pressing_.sweeps();
    if (options_.untangles) leadApart(instant);

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
    for (int i : pressing_.points()) take(i);
    for (const Crossing& crossing : crossings_)
        for (int i : crossing.points) take(i);
    if (moved.empty()) return;
    makeAscending(moved);
    give(instant, moved);
}

void Group::leadApart(const Instant& instant) {
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

std::vector<const MeetingPair*> Group::uncertified(const Instant& instant) const {
    std::vector<const MeetingPair*> bad;
    for (const MeetingPair& pair : pairs_)
        if (!isCertified(pair, instant.x0, instant.x1)) bad.push_back(&pair);
    return bad;
}

// Points went elsewhere than the near pairs were found for; only where that may have brought others near.
void Group::refind(const Instant& instant, std::span<const int> moved) {
    double most = 0;
    for (int i : moved) {
        const dvec3 d = instant.x1[static_cast<std::size_t>(i)] - xIs_[static_cast<std::size_t>(i)];
        most = std::max(most, glm::dot(d, d));
    }
    if (near_.holdWithin(std::sqrt(most))) return;
    near_.find(instant.x0, instant.x1);
    locate(instant.x0, instant.x1);
    std::copy(instant.x1.begin(), instant.x1.end(), xIs_.begin());
}

void Group::guard(const Instant& instant) {
    if (!moved_.empty()) refind(instant, moved_);
    for (int round = 0; round < mostSlides + mostZones; ++round) {
        const std::vector<const MeetingPair*> bad = uncertified(instant);
        meeting_.uncertified = static_cast<int>(bad.size());
        if (bad.empty()) return;
        std::vector<int> moved;
        if (round < mostSlides && options_.slides) {
            for (const MeetingPair* pair : bad)
                slideApart(*pair, instant.inverseMass, instant.held, instant.x1, instant.v, moved);
            meeting_.slides += static_cast<int>(bad.size());
        } else {
            moveAsZones(bad, instant.inverseMass, instant.h, instant.x0, instant.x1, instant.v, moved);
            ++meeting_.zones;
        }
        if (moved.empty()) break;
        makeAscending(moved);
        give(instant, moved);
        refind(instant, moved_);
    }
    meeting_.uncertified = static_cast<int>(uncertified(instant).size());
}

std::vector<Touching> Group::touching(std::span<const dvec3> x) const {
    std::vector<Touching> all;
    for (std::size_t p = 0; p < pressed_.size(); ++p) {
        const MeetingPair& pair = pressed_[p];
        const double impulse = p < pressing_.impulses().size() ? pressing_.impulses()[p] : 0.0;
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

std::uint64_t Group::bytes() const {
    return elements_.bytes() + near_.bytes() + pairs_.capacity() * sizeof(MeetingPair) +
           xIs_.size() * 5 * sizeof(dvec3);
}

double distanceBetween(const Elements& elements, Patches& patches, std::span<const dvec3> x,
                       const std::function<bool(int surface)>& isFirst,
                       const std::function<bool(int surface)>& isSecond) {
    patches.start(x, x);
    patches.followAll(x, x);
    const auto at = [&](int i) -> const dvec3& { return x[static_cast<std::size_t>(i)]; };
    double least = 1e300;
    // Calls each(a, b) for patches of both sides whose boxes are nearer than the least so far.
    const auto forEachNear = [&](auto&& each) {
        for (int a = 0; a < patches.count(); ++a) {
            if (!isFirst(patches[a].surface)) continue;
            for (int b = 0; b < patches.count(); ++b) {
                if (!isSecond(patches[b].surface)) continue;
                const Box &p = patches.motion(a).box, &q = patches.motion(b).box;
                const dvec3 gap = glm::max(dvec3(0.0), glm::max(p.low - q.high, q.low - p.high));
                const double bound = glm::dot(gap, gap);
                if (bound < least) each(a, b, bound);
            }
        }
    };
    const auto points = [&](const Patch& of, const Patch& triangles) {
        for (int i : of.points)
            for (int t : triangles.triangles) {
                const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(t)];
                const std::array<int, 3>& c = triangle.points;
                if (triangle.isGone || i == c[0] || i == c[1] || i == c[2]) continue;
                const OnTriangle on = nearestOnTriangle(at(i), at(c[0]), at(c[1]), at(c[2]));
                const dvec3 d =
                    at(i) - (on.weights[0] * at(c[0]) + on.weights[1] * at(c[1]) + on.weights[2] * at(c[2]));
                least = std::min(least, glm::dot(d, d));
            }
    };
    const auto measure = [&](int first, int second) {
        const Patch &a = patches[first], &b = patches[second];
        points(a, b);
        points(b, a);
        for (int e : a.edges)
            for (int f : b.edges) {
                const Edge &own = elements.edges()[static_cast<std::size_t>(e)],
                           &other = elements.edges()[static_cast<std::size_t>(f)];
                if (own.isGone || other.isGone) continue;
                const OnSegments on = nearestOnSegments(at(own.a), at(own.b), at(other.a), at(other.b));
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
