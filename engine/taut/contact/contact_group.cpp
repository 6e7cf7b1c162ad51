#include "taut/contact/contact_group.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "taut/contact/certificate.h"
#include "taut/contact/closest_points.h"
#include "taut/contact/rigid_side.h"

namespace taut::contact {
namespace {

constexpr int mostSlides = 8, mostZones = 12;
constexpr double apartSpeed = 0.3;  // [m/s] at which crossings come apart
constexpr int mostSqueezes = 3;     // rounds of letting through

// Sorts, and removes duplicates. Usually there is nothing to do.
void makeAscending(std::vector<int>& points) {
    if (std::adjacent_find(points.begin(), points.end(), std::greater_equal<>()) == points.end()) return;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

}  // namespace

ContactGroup::ContactGroup(std::vector<ContactSurface> surfaces, std::vector<dvec3> rest, const ContactOptions& options)
    : options_(options), elements_(std::move(surfaces), std::move(rest)), broadPhase_(elements_) {
    const auto count = static_cast<std::size_t>(elements_.pointCount());
    u0_.resize(count);
    u_.resize(count);
    start_.resize(count);
    v_.resize(count);
    shift_.resize(count);
    marks_.assign(count, unmarked);
}

void ContactGroup::setSolids(std::vector<Solid> solids) {
    solids_ = std::move(solids);
    solver_.setSolids(solids_, static_cast<std::size_t>(elements_.pointCount()));
}

void ContactGroup::setCarried(CarriedPoints carried) {
    carried_ = std::move(carried);
    solver_.setCarried(carried_);
}

void ContactGroup::drop() {
    broadPhase_.refresh();
    active_.clear();
    solver_.clear();
    isCertified_ = false;
}

void ContactGroup::rewind(std::span<const dvec3> x, std::span<const KeptForce> kept) {
    solver_.startFrom(kept);
    isCertified_ = crossings_.empty();
    xCertified_.assign(x.begin(), x.end());
}

void ContactGroup::begin(std::span<const dvec3> x, std::span<const KeptForce> kept) {
    solver_.startFrom(kept);
    for (const Crossing& crossing : crossings_)
        for (int i : crossing.points) marks_[static_cast<std::size_t>(i)] = unmarked;
    if (isCertified_ && std::equal(x.begin(), x.end(), xCertified_.begin(), xCertified_.end()))
        crossings_.clear();
    else
        crossings_ = crossingsAt(x);
    isCertified_ = crossings_.empty();
    xCertified_.assign(x.begin(), x.end());
    if (!options_.untangles) return;
    // The narrow phase leaves out pairs with points on the wrong side: see isTangled().
    for (const Crossing& crossing : crossings_)
        for (std::size_t k = 0; k < 5; ++k) {
            char& mark = marks_[static_cast<std::size_t>(crossing.points[k])];
            mark = std::max<char>(mark, crossing.areThrough[k] ? wrongSide : anySide);
        }
}

std::vector<Crossing> ContactGroup::crossingsAt(std::span<const dvec3> x) {
    return findCrossings(elements_, broadPhase_.bvh(), x);
}

int ContactGroup::open(const Block& block) {
    block_ = block;
    result_ = {};
    moved_.clear();
    squeezed_.clear();
    // Something else has moved points since.
    isCertified_ = isCertified_ && std::equal(block.x0.begin(), block.x0.end(), xCertified_.begin(), xCertified_.end());
    detect();
    selectActive();
    block_.steps = measureWays();
    setExpected(static_cast<double>(block_.steps) / block.steps);
    beginRows();
    return block_.steps;
}

// Returns so many of the steps that the sides of no pair go further than they may -> wayOfStep_.
int ContactGroup::measureWays() {
    double square = 0;
    for (const ContactConstraint& pair : active_) {
        if (pair.places) continue;
        dvec3 way(0.0);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(pair.points[k]);
            way += pair.weights[k] * (block_.ahead[i] - block_.x0[i]);
        }
        square = std::max(square, glm::dot(way, way) / (pair.thickness * pair.thickness));
    }
    const double way = std::sqrt(square);
    wayOfStep_ = way / block_.steps;
    return way > block_.mostWay ? std::max(1, static_cast<int>(block_.steps * block_.mostWay / way)) : block_.steps;
}

bool ContactGroup::hasRows() const {
    return !active_.empty() || !crossings_.empty() || !solids_.empty() ||
           std::any_of(
               block_.kinematic.begin(), block_.kinematic.end(), [](const auto& own) { return own.isWhole; });
}

void ContactGroup::beginRows() {
    for (const int i : solver_.points()) shift_[static_cast<std::size_t>(i)] = dvec3(0.0);
    solver_.clear();
    SolverBlock own{active_, block_.kinematic, block_.inverseMass, block_.x0, block_.h, block_.steps, options_.solver};
    own.options.restSpeed = std::max(own.options.restSpeed, block_.restSpeed);
    solver_.begin(own);
    solver_.findShift(shift_);
    for (const int i : solver_.points()) shift_[static_cast<std::size_t>(i)] /= block_.steps;
}

void ContactGroup::step(const Step& step) {
    moved_.clear();
    if (!hasRows()) return;
    solveActive(step);
    result_.impulses = std::max(result_.impulses, solver_.countImpulses());
    if (options_.untangles && !crossings_.empty()) changeAsBodies(step.x0, u_, v_, [&] { untangle(); });
    handOver(step, applyVelocities(step));
    makeAscending(moved_);
    result_.moved = moved_;
}

bool ContactGroup::close(std::span<dvec3> x, std::span<dvec3> v) {
    moved_ = result_.moved;
    solver_.end();
    return certify(x, v);
}

// Points are not where they were expected. Rounds until every pair has a certificate: the first use slide apart, the
// others impact zones.
bool ContactGroup::certify(std::span<dvec3> x, std::span<dvec3> v) {
    const Step whole{block_.x0, x, v, {}};
    bool movesAny = false;
    for (int round = 0; options_.certifies; ++round) {
        detectAgain(x);
        const std::vector<const ContactConstraint*> bad = uncertified(x);
        result_.uncertified = static_cast<int>(bad.size());
        if (bad.empty() || round == mostSlides + mostZones) break;
        const std::vector<int> moved = separate(whole, bad, round);
        if (moved.empty()) break;
        movesAny = true;
        handOver(whole, moved);
    }
    makeAscending(moved_);
    result_.moved = moved_;
    return movesAny;
}

void ContactGroup::finish(std::span<const dvec3> x) {
    isCertified_ = isCertified_ && options_.certifies && result_.uncertified == 0 && squeezed_.empty() &&
                   std::all_of(tested_.begin(), tested_.end(), [](const auto& pair) { return pair.hasSides(); });
    if (isCertified_) xCertified_.assign(x.begin(), x.end());
}

// Where the points are after this share of their way ahead -> expected_.
void ContactGroup::setExpected(double share) {
    expected_.resize(block_.x0.size());
    for (std::size_t i = 0; i < expected_.size(); ++i)
        expected_[i] = block_.x0[i] + share * (block_.ahead[i] - block_.x0[i]);
}

void ContactGroup::detect() {
    setExpected(openWay());
    broadPhase_.find(block_.x0, expected_);
    tested_.clear();
    runNarrowPhase({block_.x0, block_.ahead, true});
}

// Selects the active pairs that contact can move.
void ContactGroup::selectActive() {
    active_.clear();
    for (const ContactConstraint& pair : tested_)
        if (pair.isActive && mayYield(pair, block_.inverseMass)) active_.push_back(pair);
    for (const ContactConstraint& pair : block_.rigid)
        if (mayYield(pair, block_.inverseMass)) active_.push_back(pair);
}

// Loads the points of rows and crossings. No others are read.
void ContactGroup::load(const Step& step) {
    const auto load = [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        u0_[k] = u_[k] = (step.x1[k] - step.x0[k]) / block_.h;
        start_[k] = 0.5 * (u_[k] + step.before[k]);
        v_[k] = step.v[k];
    };
    for (const int i : solver_.points()) load(i);
    if (crossings_.empty()) return;
    for (const Crossing& crossing : crossings_)
        for (int point : crossing.points) {
            load(point);
            carried_.forEachMover(point, [&](int i, double) { load(i); });
        }
    for (const Solid& solid : solids_)
        for (int i : solid.points) load(i);
}

void ContactGroup::solveActive(const Step& step) {
    load(step);
    solver_.step(step.x0, start_, u_, v_);
    for (int round = 0; round < mostSqueezes && findSqueezed(); ++round) {
        std::erase_if(active_, [&](const ContactConstraint& pair) { return isLetThrough(pair); });
        beginRows();
        load(step);
        solver_.step(step.x0, start_, u_, v_);
    }
}

std::vector<int> ContactGroup::applyVelocities(const Step& step) const {
    std::vector<int> moved;
    const auto apply = [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        if (!(block_.inverseMass[k] > 0)) return;
        if (u_[k] == u0_[k] && v_[k] == step.v[k] && shift_[k] == dvec3(0.0)) return;
        step.x1[k] += block_.h * (u_[k] - u0_[k]) + shift_[k];
        step.v[k] = v_[k];
        moved.push_back(i);
    };
    if (crossings_.empty()) {
        for (int i : solver_.points()) apply(i);
        return moved;
    }
    std::vector<int> points(solver_.points().begin(), solver_.points().end());
    for (const Crossing& crossing : crossings_)
        for (int point : crossing.points) carried_.forEachMover(point, [&](int i, double) { points.push_back(i); });
    for (const Solid& solid : solids_) points.insert(points.end(), solid.points.begin(), solid.points.end());
    makeAscending(points);
    for (int i : points) apply(i);
    return moved;
}

// What `change` does with single points of solids in two fields, impulses do with the solids: all points of one move as
// such impulses at its points move it. Likewise impulses at the movers of carried points take the place of what it does
// with these. Returns the points that this moved.
std::vector<int> ContactGroup::changeAsBodies(std::span<const dvec3> x, std::span<dvec3> a, std::span<dvec3> b,
                                              const std::function<void()>& change) const {
    std::vector<dvec3> before;
    for (const Solid& solid : solids_)
        for (int i : solid.points)
            for (const auto& field : {a, b}) before.push_back(field[static_cast<std::size_t>(i)]);
    const auto firstCarried = static_cast<std::size_t>(carried_.first());
    const auto carriedOf = [&](std::span<dvec3> field) {
        return field.subspan(firstCarried, static_cast<std::size_t>(carried_.end()) - firstCarried);
    };
    std::array<std::vector<dvec3>, 2> carriedBefore;
    for (std::size_t part = 0; part < 2; ++part) {
        const std::span<dvec3> own = carriedOf(part == 0 ? a : b);
        carriedBefore[part].assign(own.begin(), own.end());
    }
    change();
    struct Change {
        const Solid* solid;
        std::span<dvec3> field;
        core::RigidMotion motion;
    };
    std::vector<Change> all;
    std::vector<int> moved;
    std::vector<dvec3> places, changes;
    double share = 1;
    for (std::size_t first = 0, s = 0; s < solids_.size(); first += 2 * solids_[s++].points.size()) {
        const Solid& solid = solids_[s];
        const std::size_t count = all.size();
        for (std::size_t part = 0; part < 2; ++part) {
            const std::span<dvec3> field = part == 0 ? a : b;
            places.clear();
            changes.clear();
            double wanted = 0;
            for (std::size_t n = 0; n < solid.points.size(); ++n) {
                const auto i = static_cast<std::size_t>(solid.points[n]);
                dvec3& own = field[i];
                places.push_back(x[i]);
                changes.push_back(own - before[first + 2 * n + part]);
                wanted = std::max(wanted, glm::dot(changes.back(), changes.back()));
                own -= changes.back();
            }
            if (!(wanted > 0) || !solid.moves) continue;
            // A point was moved as if it had the mass of all.
            core::RigidMotion motion = core::rigidMotionOf(solid.masses, places, changes);
            dvec3 moment(0.0);
            motion.velocity = dvec3(0.0);
            for (std::size_t n = 0; n < changes.size(); ++n) {
                motion.velocity += changes[n];
                moment += glm::cross(places[n] - motion.centre, motion.mass * changes[n]);
            }
            motion.spin = motion.inverseInertia * moment;
            double most = 0;
            for (const dvec3& place : places) {
                const dvec3 own = motion.velocityAt(place);
                most = std::max(most, glm::dot(own, own));
            }
            if (most > wanted) share = std::min(share, std::sqrt(wanted / most));
            all.push_back({&solid, field, motion});
        }
        if (all.size() > count) moved.insert(moved.end(), solid.points.begin(), solid.points.end());
    }
    std::array<std::map<int, dvec3>, 2> moversChange;
    for (std::size_t part = 0; part < 2; ++part) {
        const std::span<dvec3> field = part == 0 ? a : b;
        std::vector<int> changed;
        double wanted = 0, most = 0;
        for (int point = carried_.first(); point < carried_.end(); ++point) {
            const auto i = static_cast<std::size_t>(point);
            const dvec3 own = field[i] - carriedBefore[part][i - firstCarried];
            const double square = glm::dot(own, own);
            if (!(square > 0)) continue;
            field[i] -= own;
            changed.push_back(point);
            wanted = std::max(wanted, square);
            carried_.forEachMover(point, [&](int mover, double weight) {
                const double gain = weight * block_.inverseMass[static_cast<std::size_t>(mover)];
                if (gain != 0) moversChange[part][mover] += gain / block_.inverseMass[i] * own;
            });
        }
        for (int point : changed) {
            dvec3 own(0.0);
            carried_.forEachMover(point, [&](int mover, double weight) {
                if (const auto at = moversChange[part].find(mover); at != moversChange[part].end())
                    own += weight * at->second;
            });
            most = std::max(most, glm::dot(own, own));
        }
        if (most > wanted) share = std::min(share, std::sqrt(wanted / most));
    }
    // Many points that want the same move their body once, and as far. All go by one share, which keeps momenta.
    for (const Change& own : all)
        for (int i : own.solid->points) {
            const auto k = static_cast<std::size_t>(i);
            own.field[k] += share * own.motion.velocityAt(x[k]);
        }
    for (std::size_t part = 0; part < 2; ++part)
        for (const auto& [mover, own] : moversChange[part]) {
            (part == 0 ? a : b)[static_cast<std::size_t>(mover)] += share * own;
            moved.push_back(mover);
        }
    return moved;
}

// The carried points that go with any of these, ascending.
std::vector<int> ContactGroup::movedBy(std::span<const int> points) const {
    std::vector<char> moves(u_.size(), 0);
    for (int i : points) moves[static_cast<std::size_t>(i)] = 1;
    std::vector<int> moved;
    for (int i = carried_.first(); i < carried_.end(); ++i) {
        char goes = 0;
        carried_.forEachMover(i, [&](int mover, double) { goes |= moves[static_cast<std::size_t>(mover)]; });
        if (goes != 0) moved.push_back(i);
    }
    return moved;
}

// Hands these points (ascending) to their islands. The islands place them, and may change x1 and v once more.
void ContactGroup::handOver(const Step& step, std::span<const int> points) {
    if (points.empty()) return;
    const auto take = [&](std::span<const int> own) { moved_.insert(moved_.end(), own.begin(), own.end()); };
    take(points);
    if (block_.place) block_.place(points);
    if (carried_.isEmpty()) return;
    const std::vector<int> carried = movedBy(points);
    for (int i : carried) {
        step.x1[static_cast<std::size_t>(i)] = carried_.valueAt(i, step.x1);
        step.v[static_cast<std::size_t>(i)] = carried_.valueAt(i, step.v);
    }
    take(carried);
}

// Gives each edge that pierces a triangle an impulse along the way out (crossings.h), one edge after the other.
void ContactGroup::untangle() {
    for (const Crossing& crossing : crossings_) {
        // Effective inverse mass along the way out, the speeds u and v along it, and the largest gain of a point.
        double inverse = 0, speed = 0, speedV = 0, most = 0;
        for (std::size_t k = 0; k < 5; ++k) {
            const auto i = static_cast<std::size_t>(crossing.points[k]);
            inverse += crossing.weights[k] * crossing.weights[k] * block_.inverseMass[i];
            most = std::max(most, std::abs(crossing.weights[k]) * block_.inverseMass[i]);
            speed += crossing.weights[k] * glm::dot(u_[i], crossing.separatingDirection);
            speedV += crossing.weights[k] * glm::dot(v_[i], crossing.separatingDirection);
        }
        if (!(inverse > 0) || crossing.separatingDirection == dvec3(0.0)) continue;
        if (!mayYield(crossing, block_.inverseMass)) continue;
        // The impulse brings the speed up to apartSpeed. It has two limits. It is never more than a crossing at rest
        // needs, no matter what pushes against it. And no point gains more than apartSpeed, no matter how small its
        // weight. A pinch then stays until it opens.
        const auto impulseAgainst = [&](double before) {
            return std::min(std::clamp(apartSpeed - before, 0.0, apartSpeed) / inverse, apartSpeed / most);
        };
        const double impulse = impulseAgainst(speed), impulseV = impulseAgainst(speedV);
        for (std::size_t k = 0; k < 5; ++k) {
            const auto i = static_cast<std::size_t>(crossing.points[k]);
            const double share = crossing.weights[k] * block_.inverseMass[i];
            u_[i] += (share * impulse) * crossing.separatingDirection;
            v_[i] += (share * impulseV) * crossing.separatingDirection;
        }
    }
}

std::vector<const ContactConstraint*> ContactGroup::uncertified(std::span<const dvec3> x) const {
    std::vector<const ContactConstraint*> bad;
    for (const ContactConstraint& pair : tested_)
        if (pair.hasSides() && !isCertified(pair, block_.x0, x) && !isLetThrough(pair)) bad.push_back(&pair);
    return bad;
}

// Points were moved after the detection, which may have brought new pairs into reach. These get a certificate; impulses
// they may get in the next block.
void ContactGroup::detectAgain(std::span<const dvec3> x) {
    broadPhase_.findAstray(expected_, block_.x0, x);
    runNarrowPhase({block_.x0, x, false});
}

// Moves pairs that have no certificate. Returns the points that it moved, ascending.
std::vector<int> ContactGroup::separate(const Step& step, std::span<const ContactConstraint* const> pairs, int round) {
    std::vector<int> moved;
    const std::vector<int> ofBodies = changeAsBodies(
        step.x0, step.x1, step.v,
        [&] {
            if (round < mostSlides && options_.slides) {
                for (const ContactConstraint* pair : pairs)
                    slideApart(*pair, block_.inverseMass, block_.kinematic, step.x1, step.v, moved);
                result_.slides += static_cast<int>(pairs.size());
            } else {
                moveAsImpactZones(pairs, block_.inverseMass, block_.steps * block_.h, step.x0, step.x1, step.v, moved);
                ++result_.zones;
            }
        });
    std::erase_if(moved, [&](int i) { return carried_.has(i); });
    moved.insert(moved.end(), ofBodies.begin(), ofBodies.end());
    makeAscending(moved);
    return moved;
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
        all.push_back({pair.places ? 0.5 * ((*pair.places)[0] + (*pair.places)[1]) : 0.5 * (first - second),
                       pair.normal, impulse, elements_.surfaceOf(pair.points[0]), elements_.surfaceOf(pair.points[3])});
    }
    return all;
}

std::uint64_t ContactGroup::bytes() const {
    return elements_.bytes() + broadPhase_.bytes() + tested_.capacity() * sizeof(ContactConstraint) +
           u_.size() * 6 * sizeof(dvec3);
}

// Over 60 lines: its steps share the least distance so far, and each is short.
double distanceBetween(const Elements& elements, Bvh& leaves, std::span<const dvec3> x,
                       const std::function<bool(int surface)>& isFirst,
                       const std::function<bool(int surface)>& isSecond) {
    leaves.fit(x, x);
    const auto at = [&](int i) -> const dvec3& { return x[static_cast<std::size_t>(i)]; };
    double least = 1e300;
    // Calls each(a, b, bound) for leaves of both kinds whose boxes are closer than the least distance so far.
    const auto forEachNear = [&](auto&& each) {
        for (int a = 0; a < leaves.count(); ++a) {
            if (!isFirst(leaves[a].surface)) continue;
            for (int b = 0; b < leaves.count(); ++b) {
                if (!isSecond(leaves[b].surface)) continue;
                const core::Aabb &p = leaves.motion(a).box, &q = leaves.motion(b).box;
                const dvec3 gap = glm::max(dvec3(0.0), glm::max(p.low - q.high, q.low - p.high));
                const double bound = glm::dot(gap, gap);
                if (bound < least) each(a, b, bound);
            }
        }
    };
    const auto take = [&](const Corners& corners, bool isPoint) {
        const dvec3 d = closestPoints(corners, isPoint).separation;
        least = std::min(least, glm::dot(d, d));
    };
    // Points of one leaf against triangles of the other.
    const auto measurePoints = [&](const BvhLeaf& of, const BvhLeaf& triangles) {
        for (int i : of.points)
            for (int t : triangles.triangles) {
                const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(t)];
                const std::array<int, 3>& c = triangle.points;
                if (!triangle.isGone && i != c[0] && i != c[1] && i != c[2])
                    take({at(i), at(c[0]), at(c[1]), at(c[2])}, true);
            }
    };
    // All pairs of elements of two leaves.
    const auto measure = [&](int first, int second) {
        const BvhLeaf &a = leaves[first], &b = leaves[second];
        measurePoints(a, b);
        measurePoints(b, a);
        for (int e : a.edges)
            for (int f : b.edges) {
                const Edge &own = elements.edges()[static_cast<std::size_t>(e)],
                           &other = elements.edges()[static_cast<std::size_t>(f)];
                if (!own.isGone && !other.isGone) take({at(own.a), at(own.b), at(other.a), at(other.b)}, false);
            }
    };
    // First the two leaves whose boxes are closest, for a good bound. Then all pairs that may still be closer.
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
