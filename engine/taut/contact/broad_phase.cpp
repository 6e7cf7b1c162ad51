#include "taut/contact/broad_phase.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "taut/contact/closest_points.h"
#include "taut/core/parallel.h"

namespace taut::contact {
namespace {

constexpr int atOnce = 8;          // lists a task
constexpr double bentShare = 0.4;  // of the largest thickness: leaves bent further are remembered anew
constexpr double roomShare = 0.5;  // of it: room between boxes that are found near beforehand
constexpr double flatShare = 0.1;  // of the thickness: what is flat with less to spare is listed nevertheless
constexpr double mostAhead = 8;    // instants for which a search is to last
constexpr double mostRoom = 4;     // of that room, that boxes may grow for it

// [m] between two boxes, at least.
double gapOf(const Box& a, const Box& b) {
    return length(glm::max(dvec3(0.0), glm::max(a.low - b.high, b.low - a.high)));
}

}  // namespace

void BroadPhase::drop() {
    lists_.clear();
    unused_.clear();
    known_.clear();
    awake_.clear();
    roomy_.clear();
    bvh_.takeBalls();
    looked_.clear();
    stray_.assign(static_cast<std::size_t>(bvh_.count()), 0.0);
    gone_.assign(static_cast<std::size_t>(bvh_.count()), 0.0);
}

void BroadPhase::clear(CandidateList& list) {
    list.pairs.clear();
    list.nearTravelled.clear();
    list.nearApproached.clear();
    list.pointPairs = 0;
}

BroadPhase::CandidateList* BroadPhase::newList(LeafPair pair) {
    if (unused_.empty()) unused_.push_back(&lists_.emplace_back());
    CandidateList* list = unused_.back();
    unused_.pop_back();
    CandidateList fresh;
    fresh.pairs = std::move(list->pairs);
    fresh.nearTravelled = std::move(list->nearTravelled);
    fresh.nearApproached = std::move(list->nearApproached);
    *list = std::move(fresh);
    clear(*list);
    list->a = lowOf(pair);
    list->b = highOf(pair);
    list->about = bvh_.about(list->a, list->b);
    const int a = bvh_[list->a].surface, b = bvh_[list->b].surface;
    list->most = elements_.surface(a).thickness + elements_.surface(b).thickness;
    if (!elements_.shareBond(a, b))
        list->apartAtLeast = list->most;
    else if (a == b && bvh_.isPlane(a))
        list->apartAtLeast = std::min(list->most, restShare * bvh_.leastAltitude(a));
    return list;
}

double BroadPhase::comingOf(const CandidateList& list) const {
    const LeafMotion &a = bvh_.motion(list.a), &b = bvh_.motion(list.b);
    return (list.a == list.b ? 0.0 : length(a.way - b.way)) + a.stray + b.stray;
}

void BroadPhase::approach(CandidateList& list) const {
    const LeafMotion &a = bvh_.motion(list.a), &b = bvh_.motion(list.b);
    const double strayA = stray_[static_cast<std::size_t>(list.a)] - list.strayA;
    const double strayB = stray_[static_cast<std::size_t>(list.b)] - list.strayB;
    const bool isOne = list.a == list.b;
    list.coming = comingOf(list);
    // Between the means, before and after; and of the points about them.
    double between = 0;
    if (!isOne) {
        const dvec3 before = a.centre - b.centre - list.apart, after = before + a.way - b.way;
        between = std::sqrt(std::max(glm::dot(before, before), glm::dot(after, after)));
    }
    const double ownA = strayA + a.stray, ownB = strayB + b.stray;
    const double bentA = a.times == list.timesA ? a.bent + list.bentA : ownA;
    const double bentB = b.times == list.timesB ? b.bent + list.bentB : ownB;
    list.approached = between + std::min(ownA, bentA) + std::min(ownB, bentB);
    list.travelled = list.way + list.coming;
}

// Whether all of one leaf stays further from all of the other than any pair of them is near, along the way between
// their middles, before and after, and so in between.
bool BroadPhase::passesBy(const CandidateList& list, std::span<const dvec3> x0, std::span<const dvec3> x1) const {
    const LeafMotion &a = bvh_.motion(list.a), &b = bvh_.motion(list.b);
    const dvec3 between = a.centre - b.centre + 0.5 * (a.way - b.way);
    const double size = length(between);
    if (!(size > 0)) return false;
    const dvec3 axis = between / size;
    for (const auto& x : {x0, std::span<const dvec3>(x1)}) {
        double low = 1e300, high = -1e300;
        for (int i : bvh_[list.a].corners) low = std::min(low, glm::dot(axis, x[static_cast<std::size_t>(i)]));
        for (int i : bvh_[list.b].corners) high = std::max(high, glm::dot(axis, x[static_cast<std::size_t>(i)]));
        if (!(low - high > nearShare * list.most)) return false;
    }
    return true;
}

bool BroadPhase::staysWhereSearched(std::span<const dvec3> x0, std::span<const dvec3> x1, double bent) {
    if (roomy_.empty()) return false;
    leafList_.clear();
    for (int p = 0; p < bvh_.count(); ++p) {
        const auto k = static_cast<std::size_t>(p);
        if (gone_[k] + bvh_.going(p) - goneThen_[k] > lasting_) leafList_.push_back(p);
    }
    bvh_.follow(leafList_, x0, x1, bent);
    for (int p : leafList_) {
        const Box &box = bvh_.motion(p).box, &roomy = roomy_[static_cast<std::size_t>(p)];
        if (!(box.low.x >= roomy.low.x && box.low.y >= roomy.low.y && box.low.z >= roomy.low.z &&
              box.high.x <= roomy.high.x && box.high.y <= roomy.high.y && box.high.z <= roomy.high.z))
            return false;
    }
    return true;
}

// For as many instants like this one as pay.
void BroadPhase::search(double room) {
    double most = 0;
    for (int p = 0; p < bvh_.count(); ++p) most = std::max(most, bvh_.going(p));
    const double instants = mostAhead * most > mostRoom * room ? mostRoom * room / most : mostAhead;
    roomy_.resize(static_cast<std::size_t>(bvh_.count()));
    goneThen_ = gone_;
    lasting_ = instants < 1 ? 0.0 : room;
    for (int p = 0; p < bvh_.count(); ++p) {
        const LeafMotion& motion = bvh_.motion(p);
        Box& roomy = roomy_[static_cast<std::size_t>(p)];
        roomy = motion.box;
        if (instants < 1) continue;
        const dvec3 way = instants * motion.way;
        const double aside = room + instants * motion.stray;
        roomy.low += glm::min(way, dvec3(0.0)) - aside;
        roomy.high += glm::max(way, dvec3(0.0)) + aside;
    }
    bvh_.findNear(roomy_, room, found_);

    merged_.clear();
    auto old = known_.begin();
    const auto forgetUntil = [&](LeafPair pair) {
        for (; old != known_.end() && old->pair < pair; ++old) unused_.push_back(old->list);
    };
    for (LeafPair pair : found_) {
        forgetUntil(pair);
        if (old != known_.end() && old->pair == pair)
            merged_.push_back(*old++);
        else
            merged_.push_back({pair, newList(pair), -1, 0, goneOf(pair)});
    }
    forgetUntil(~LeafPair{0});
    std::swap(known_, merged_);
}

double BroadPhase::goneOf(LeafPair pair) const {
    return gone_[static_cast<std::size_t>(lowOf(pair))] + gone_[static_cast<std::size_t>(highOf(pair))];
}

// Whether the list of a list holds in this instant, or need not.
void BroadPhase::look(Known& known, std::span<const dvec3> x0, std::span<const dvec3> x1) const {
    CandidateList& list = *known.list;
    const double gone = goneOf(known.pair);
    list.way += gone - known.counted;
    known.counted = gone;
    known.quiet = -1;
    approach(list);
    list.isFlat = list.isPassing = false;
    list.isNew = list.approached > list.valid;
    if (!list.isNew) return;
    const double between = gapOf(bvh_.motion(list.a).before, bvh_.motion(list.b).before);
    const double apart = between - nearShare * list.most;
    if (apart > list.coming) {
        list.isNew = false;
        restart(list, apart);
    } else if (apart > 0 && passesBy(list, x0, x1)) {
        list.isNew = false;
        list.isPassing = true;
    }
}

void BroadPhase::find(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    stray_.resize(static_cast<std::size_t>(bvh_.count()), 0.0);
    gone_.resize(static_cast<std::size_t>(bvh_.count()), 0.0);
    double thickest = 0;
    for (const Surface& surface : elements_.surfaces())
        if (!surface.isRigid) thickest = std::max(thickest, surface.thickness);
    const double room = roomShare * thickest, bent = bentShare * thickest;
    bvh_.start(x0, x1);
    if (!staysWhereSearched(x0, x1, bent)) {
        bvh_.followAll(x0, x1, bent);
        search(room);
    }

    const int count = static_cast<int>(known_.size()), tasks = (count + atOnce - 1) / atOnce;
    isLooked_.resize(known_.size());
    slacks_.assign(static_cast<std::size_t>(tasks), room);
    core::parallelFor(tasks, [&](int task) {
        double& slack = slacks_[static_cast<std::size_t>(task)];
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, count); ++k) {
            const Known& known = known_[static_cast<std::size_t>(k)];
            const double going = bvh_.going(lowOf(known.pair)) + bvh_.going(highOf(known.pair));
            const double left = known.quiet - (goneOf(known.pair) + going - known.since);
            isLooked_[static_cast<std::size_t>(k)] = left > 0 ? 0 : 1;
            if (left > 0) slack = std::min({slack, left + known.apartAtLeast, watchShare * known.leastThickness});
        }
    });
    looked_.clear();
    leafList_.clear();
    for (std::size_t k = 0; k < known_.size(); ++k) {
        if (isLooked_[k] == 0) continue;
        looked_.push_back(&known_[k]);
        leafList_.push_back(lowOf(known_[k].pair));
        leafList_.push_back(highOf(known_[k].pair));
    }
    bvh_.follow(leafList_, x0, x1, bent);
    const int looked = static_cast<int>(looked_.size());
    core::parallelFor((looked + atOnce - 1) / atOnce, [&](int task) {
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, looked); ++k)
            look(*looked_[static_cast<std::size_t>(k)], x0, x1);
    });
    awake_.clear();
    about_.clear();
    for (const Known* known : looked_) {
        CandidateList* list = known->list;
        if (list->isPassing) continue;
        if (!list->isNew && list->travelled < list->asleepTravelled && list->approached < list->asleepApproached)
            continue;
        awake_.push_back(list);
        about_.insert(about_.end(), list->about.begin(), list->about.end());
    }
    bvh_.measureFlatness(about_, x0, x1);
    std::atomic<std::size_t> made{0};
    const int stirring = static_cast<int>(awake_.size());
    core::parallelFor((stirring + atOnce - 1) / atOnce, [&](int task) {
        std::size_t own = 0;
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, stirring); ++k) {
            CandidateList& list = *awake_[static_cast<std::size_t>(k)];
            const int surface = bvh_[list.a].surface;
            const double more = bvh_.flatness(list.about) - bvh_.enough(surface);
            const double apart = more * bvh_.leastAltitude(surface);
            list.isFlat = more >= 0;
            if (list.isFlat && apart >= flatShare * elements_.surface(surface).thickness) {
                restart(list, apart);
            } else if (list.isNew) {
                makeList(list, x0);
                ++own;
            }
        }
        made += own;
    });
    listed_ += made;
    slack_ = room;
    for (double slack : slacks_) slack_ = std::min(slack_, slack);
    for (const Known* known : looked_) {
        const CandidateList& list = *known->list;
        const double unlisted = list.isPassing ? 0.0 : list.valid - list.approached;
        slack_ = std::min({slack_, unlisted + list.apartAtLeast, watchShare * list.leastThickness});
    }
}

void BroadPhase::go(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    bvh_.start(x0, x1);
    looked_.clear();
    addWays();
}

void BroadPhase::arrive(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    bvh_.correct(moved, x0, x1);
    addWays();
}

// Those that were looked at know how far they have come nearer, the others only how far their leaves have gone.
void BroadPhase::addWays() {
    for (Known* known : looked_) {
        const CandidateList& list = *known->list;
        known->since = goneOf(known->pair);
        known->quiet = std::min({list.valid - list.approached, list.asleepTravelled - list.travelled,
                                 list.asleepApproached - list.approached});
        known->apartAtLeast = list.apartAtLeast;
        known->leastThickness = list.leastThickness;
    }
    for (int p = 0; p < bvh_.count(); ++p) {
        const auto k = static_cast<std::size_t>(p);
        stray_[k] += bvh_.isFollowed(p) ? bvh_.motion(p).stray : 2 * bvh_.going(p);
        gone_[k] += bvh_.going(p);
    }
    for (Known* known : looked_) {
        known->list->way += comingOf(*known->list);
        known->counted = goneOf(known->pair);
    }
    looked_.clear();
}

// Nothing of it is near until it has come that much nearer [m].
void BroadPhase::restart(CandidateList& list, double valid) const {
    clear(list);
    list.asleepTravelled = list.asleepApproached = 1e300;
    list.leastThickness = 1e300;
    list.valid = valid;
    list.apart = bvh_.motion(list.a).centre - bvh_.motion(list.b).centre;
    list.strayA = stray_[static_cast<std::size_t>(list.a)];
    list.strayB = stray_[static_cast<std::size_t>(list.b)];
    list.approached = list.travelled = list.coming;
    list.way = 0;
    const LeafMotion &motionA = bvh_.motion(list.a), &motionB = bvh_.motion(list.b);
    list.bentA = motionA.bent;
    list.bentB = motionB.bent;
    list.timesA = motionA.times;
    list.timesB = motionB.times;
}

std::uint64_t BroadPhase::bytes() const {
    std::uint64_t sum = lists_.size() * sizeof(CandidateList);
    for (const CandidateList& list : lists_)
        sum += list.pairs.capacity() * (sizeof(CandidatePair) + 2 * sizeof(double));
    return sum;
}

}  // namespace taut::contact
