#include "taut/contact/broad_phase.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "taut/contact/closest_points.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr int checkedAtOnce = 64, madeAtOnce = 8;  // lists per task
// Shares of the largest thickness.
constexpr double referenceShare = 0.4;  // a leaf that has deformed further takes a new reference shape
constexpr double boxMarginShare = 0.5;  // margin of fat boxes
constexpr double flatShare = 0.1;       // of the thickness: leaves that are flat with less to spare keep their list
// Fat boxes reach ahead along the motion of their leaf.
constexpr double searchAhead = 8;    // blocks, at most
constexpr double mostBoxMargin = 4;  // box margins, at most

// [m] Lower bound of the distance between the contents of two boxes.
double gapOf(const core::Aabb& a, const core::Aabb& b) {
    return length(glm::max(dvec3(0.0), glm::max(a.low - b.high, b.low - a.high)));
}

}  // namespace

void BroadPhase::drop() {
    lists_.clear();
    unused_.clear();
    tracked_.clear();
    due_.clear();
    fatBoxes_.clear();
    bvh_.takeBalls();
    bvh_.forgetStill();
    checked_.clear();
    deviation_.assign(static_cast<std::size_t>(bvh_.count()), 0.0);
    travel_.assign(static_cast<std::size_t>(bvh_.count()), 0.0);
}

void BroadPhase::clear(CandidateList& list) {
    list.pairs.clear();
    list.travelBudget.clear();
    list.approachBudget.clear();
    list.pointPairs = 0;
}

BroadPhase::CandidateList* BroadPhase::newList(LeafPair pair) {
    if (unused_.empty()) unused_.push_back(&lists_.emplace_back());
    CandidateList* list = unused_.back();
    unused_.pop_back();
    CandidateList fresh;
    fresh.pairs = std::move(list->pairs);
    fresh.travelBudget = std::move(list->travelBudget);
    fresh.approachBudget = std::move(list->approachBudget);
    *list = std::move(fresh);
    clear(*list);
    list->a = lowOf(pair);
    list->b = highOf(pair);
    list->between = bvh_.leavesBetween(list->a, list->b);
    const int a = bvh_[list->a].surface, b = bvh_[list->b].surface;
    list->thickness = elements_.surface(a).thickness + elements_.surface(b).thickness;
    return list;
}

double BroadPhase::relativeMotionOf(const CandidateList& list) const {
    const LeafMotion &a = bvh_.motion(list.a), &b = bvh_.motion(list.b);
    return (list.a == list.b ? 0.0 : length(a.way - b.way)) + a.deviation + b.deviation;
}

// What the motion of this block adds to travelled and approached.
void BroadPhase::measureMotion(CandidateList& list) const {
    const LeafMotion &a = bvh_.motion(list.a), &b = bvh_.motion(list.b);
    // Sums of deviations since the list was made.
    const double ownDeviationA = deviation_[static_cast<std::size_t>(list.a)] - list.deviationA;
    const double ownDeviationB = deviation_[static_cast<std::size_t>(list.b)] - list.deviationB;
    const bool isOne = list.a == list.b;
    list.relativeMotion = relativeMotionOf(list);
    // How far the offset of the centres has changed since the list was made, at x0 and at x1.
    double ofCentres = 0;
    if (!isOne) {
        const dvec3 before = a.centre - b.centre - list.offset, after = before + a.way - b.way;
        ofCentres = std::sqrt(std::max(glm::dot(before, before), glm::dot(after, after)));
    }
    // How far points have moved about their centre. If the reference shape is still that of the list, a point went to
    // it and back at most: the sum of the two deformations is a bound.
    const double sumA = ownDeviationA + a.deviation, sumB = ownDeviationB + b.deviation;
    const double netA = a.reference == list.referenceA ? a.deformation + list.deformationA : sumA;
    const double netB = b.reference == list.referenceB ? b.deformation + list.deformationB : sumB;
    list.approached = ofCentres + std::min(sumA, netA) + std::min(sumB, netB);
    list.travelled = list.travelledBefore + list.relativeMotion;
}

// Whether an axis keeps all of leaf a above all of leaf b, by more than near, at x0 and at x1. On straight ways this
// holds in between too (certificate.h). The axis is the line between the centres halfway from x0 to x1.
bool BroadPhase::isSeparatedOnTheWay(const CandidateList& list, std::span<const dvec3> x0,
                                     std::span<const dvec3> x1) const {
    const LeafMotion &a = bvh_.motion(list.a), &b = bvh_.motion(list.b);
    const dvec3 between = a.centre - b.centre + 0.5 * (a.way - b.way);
    const double size = length(between);
    if (!(size > 0)) return false;
    const dvec3 axis = between / size;
    for (const auto& x : {x0, std::span<const dvec3>(x1)}) {
        double low = 1e300, high = -1e300;
        for (int i : bvh_[list.a].corners) low = std::min(low, glm::dot(axis, x[static_cast<std::size_t>(i)]));
        for (int i : bvh_[list.b].corners) high = std::max(high, glm::dot(axis, x[static_cast<std::size_t>(i)]));
        if (!(low - high > nearShare * list.thickness)) return false;
    }
    return true;
}

// Whether the last search of the tree still holds. Only leaves that have gone further than freeTravel_ are measured.
bool BroadPhase::areInFatBoxes(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    if (fatBoxes_.empty()) return false;
    leafList_.clear();
    for (int p = 0; p < bvh_.count(); ++p) {
        const auto k = static_cast<std::size_t>(p);
        if (travel_[k] + bvh_.travel(p) - travelAtSearch_[k] > freeTravel_) leafList_.push_back(p);
    }
    bvh_.follow(leafList_, x0, x1, mostDeformed_);
    for (int p : leafList_) {
        const core::Aabb &box = bvh_.motion(p).box, &fat = fatBoxes_[static_cast<std::size_t>(p)];
        if (!(box.low.x >= fat.low.x && box.low.y >= fat.low.y && box.low.z >= fat.low.z && box.high.x <= fat.high.x &&
              box.high.y <= fat.high.y && box.high.z <= fat.high.z))
            return false;
    }
    return true;
}

// Makes the fat boxes, and tracks the pairs whose boxes overlap. Pairs that were tracked before keep their lists.
void BroadPhase::searchTree(double boxMargin) {
    // Boxes reach ahead for this many blocks like the present one. If points go too far even in one, they do not.
    double most = 0;
    for (int p = 0; p < bvh_.count(); ++p) most = std::max(most, bvh_.travel(p));
    const double instants =
        searchAhead * most > mostBoxMargin * boxMargin ? mostBoxMargin * boxMargin / most : searchAhead;
    fatBoxes_.resize(static_cast<std::size_t>(bvh_.count()));
    travelAtSearch_ = travel_;
    freeTravel_ = instants < 1 ? 0.0 : boxMargin;
    for (int p = 0; p < bvh_.count(); ++p) {
        const LeafMotion& motion = bvh_.motion(p);
        core::Aabb& fat = fatBoxes_[static_cast<std::size_t>(p)];
        fat = motion.box;
        if (instants < 1) continue;
        const dvec3 way = instants * motion.way;
        const double aside = boxMargin + instants * motion.deviation;
        fat.low += glm::min(way, dvec3(0.0)) - aside;
        fat.high += glm::max(way, dvec3(0.0)) + aside;
    }
    bvh_.findNear(fatBoxes_, boxMargin, found_);

    // Merges the pairs found with those tracked so far; both are ascending.
    merged_.clear();
    auto old = tracked_.begin();
    const auto releaseUntil = [&](LeafPair pair) {
        for (; old != tracked_.end() && old->pair < pair; ++old) unused_.push_back(old->list);
    };
    for (LeafPair pair : found_) {
        releaseUntil(pair);
        if (old != tracked_.end() && old->pair == pair)
            merged_.push_back(*old++);
        else
            merged_.push_back({pair, newList(pair), -1, 0, travelOf(pair), freeShiftOf(pair)});
    }
    releaseUntil(~LeafPair{0});
    std::swap(tracked_, merged_);
}

double BroadPhase::travelOf(LeafPair pair) const {
    return travel_[static_cast<std::size_t>(lowOf(pair))] + travel_[static_cast<std::size_t>(highOf(pair))];
}

// Elements of one body that is not flat at rest may be as close as they like at rest, and so keep no distance that is
// known beforehand.
double BroadPhase::freeShiftOf(LeafPair pair) const {
    const int a = bvh_[lowOf(pair)].surface, b = bvh_[highOf(pair)].surface;
    const double thickness = elements_.surface(a).thickness + elements_.surface(b).thickness;
    if (!elements_.shareBond(a, b)) return watchShare * thickness;
    return a == b && bvh_.isPlane(a) ? watchShare * std::min(thickness, restShare * bvh_.leastAltitude(a)) : 0.0;
}

// Brings the motion of a pair's list up to date, and finds out whether the list has expired.
void BroadPhase::check(TrackedPair& tracked, std::span<const dvec3> x0, std::span<const dvec3> x1) const {
    CandidateList& list = *tracked.list;
    // Instants since the last check count with the travel of the leaves. It is no less than their relative motion.
    const double travel = travelOf(tracked.pair);
    list.travelledBefore += travel - tracked.countedTravel;
    tracked.countedTravel = travel;
    tracked.motionBudget = -1;
    measureMotion(list);
    list.isSeparated = false;
    list.isExpired = list.approached > list.margin;
    if (!list.isExpired) return;
    // No new list is needed if the boxes are too far apart, or an axis separates the leaves in this block.
    const double gap = gapOf(bvh_.motion(list.a).before, bvh_.motion(list.b).before);
    const double spare = gap - nearShare * list.thickness;
    if (spare > list.relativeMotion) {
        list.isExpired = false;
        restart(list, spare);
    } else if (spare > 0 && isSeparatedOnTheWay(list, x0, x1)) {
        list.isExpired = false;
        list.isSeparated = true;
    }
}

void BroadPhase::find(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    deviation_.resize(static_cast<std::size_t>(bvh_.count()), 0.0);
    travel_.resize(static_cast<std::size_t>(bvh_.count()), 0.0);
    double thickest = 0;
    for (const ContactSurface& surface : elements_.surfaces())
        if (!surface.isOfCollider()) thickest = std::max(thickest, surface.thickness);
    mostDeformed_ = referenceShare * thickest;

    bvh_.start(x0, x1);
    pointBoxes_.clear();
    hasBoxes_.assign(static_cast<std::size_t>(bvh_.count()), 0);
    forgetChecked();
    if (!areInFatBoxes(x0, x1)) {
        bvh_.followAll(x0, x1, mostDeformed_);
        searchTree(boxMarginShare * thickest);
    }
    selectForCheck([](const TrackedPair&) { return true; });
    xFound_.assign(x1.begin(), x1.end());
    shift_.assign(static_cast<std::size_t>(bvh_.count()), 0.0);
    checkSelected(x0, x1);
}

bool BroadPhase::findAgain(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    bvh_.correct(moved, x0, x1);
    if (!areInFatBoxes(x0, x1)) return false;
    bvh_.addShifts(moved, xFound_, x1, shift_);
    selectForCheck([&](const TrackedPair& tracked) {
        const double shift = shift_[static_cast<std::size_t>(lowOf(tracked.pair))] +
                             shift_[static_cast<std::size_t>(highOf(tracked.pair))];
        return shift > tracked.freeShift;
    });
    checkSelected(x0, x1);
    return true;
}

// Whether the leaves of the pair may have moved more than it has left.
bool BroadPhase::mayUseUpBudget(const TrackedPair& tracked) const {
    const double travel = bvh_.travel(lowOf(tracked.pair)) + bvh_.travel(highOf(tracked.pair));
    return !(tracked.motionBudget - (travelOf(tracked.pair) + travel - tracked.budgetStart) > 0);
}

// Selects those tracked pairs whose leaves may have used up the motion budget -> selected_, and their leaves ->
// leafList_.
template <class MayHaveMoved>
void BroadPhase::selectForCheck(const MayHaveMoved& mayHaveMoved) {
    selected_.clear();
    leafList_.clear();
    for (TrackedPair& tracked : tracked_) {
        if (!mayHaveMoved(tracked) || !mayUseUpBudget(tracked)) continue;
        selected_.push_back(&tracked);
        leafList_.push_back(lowOf(tracked.pair));
        leafList_.push_back(highOf(tracked.pair));
        if (!tracked.isChecked) checked_.push_back(&tracked);
        tracked.isChecked = true;
    }
}

// Checks the selected pairs. The lists of those that have used up a budget are due.
void BroadPhase::checkSelected(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    bvh_.follow(leafList_, x0, x1, mostDeformed_);
    core::parallelFor(static_cast<int>(selected_.size()), checkedAtOnce,
                      [&](int k) { check(*selected_[static_cast<std::size_t>(k)], x0, x1); });
    selectDue();
    bvh_.measureFlatness(between_, x0, x1);
    findBoxes(x0);
    refreshDue(x0);
}

// Selects the checked lists that have expired or have a pair that may be near -> due_. The leaves between the two
// leaves of those that have expired -> between_.
void BroadPhase::selectDue() {
    due_.clear();
    between_.clear();
    for (const TrackedPair* tracked : selected_) {
        CandidateList* list = tracked->list;
        if (list->isSeparated) continue;
        const bool hasBudget =
            list->travelled < list->leastTravelBudget && list->approached < list->leastApproachBudget;
        if (!list->isExpired && hasBudget) continue;
        due_.push_back(list);
        if (list->isExpired) between_.insert(between_.end(), list->between.begin(), list->between.end());
    }
}

// Makes expired lists anew. Those of flat leaves stay empty.
void BroadPhase::refreshDue(std::span<const dvec3> x0) {
    std::atomic<std::size_t> made{0};
    core::parallelFor(static_cast<int>(due_.size()), madeAtOnce, [&](int k) {
        CandidateList& list = *due_[static_cast<std::size_t>(k)];
        if (!list.isExpired) return;
        // How much flatness is left: no two parts are in contact until they have approached by `spare`.
        const int surface = bvh_[list.a].surface;
        const double spare =
            (bvh_.flatness(list.between) - bvh_.requiredFlatness(surface)) * bvh_.leastAltitude(surface);
        if (spare >= flatShare * elements_.surface(surface).thickness) {
            restart(list, spare);
        } else {
            makeList(list, x0);
            ++made;
        }
    });
    listsMade_ += made;
}

void BroadPhase::advance(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    bvh_.start(x0, x1);
    forgetChecked();
    accumulateTravel();
}

void BroadPhase::finish(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    bvh_.correct(moved, x0, x1);
    accumulateTravel();
}

// The block ends. Checked pairs count their relative motion. The others count the travel of their leaves, which
// check() adds later.
void BroadPhase::accumulateTravel() {
    // What is left of the budgets of checked pairs, by how far they went in the end. Leaves that travel less than that
    // do not use it up.
    for (TrackedPair* tracked : checked_) {
        CandidateList& list = *tracked->list;
        measureMotion(list);
        tracked->budgetStart = travelOf(tracked->pair);
        tracked->motionBudget = std::min({list.margin - list.approached, list.leastTravelBudget - list.travelled,
                                          list.leastApproachBudget - list.approached});
    }
    // A leaf that was not followed deviates by no more than two ways: a point's and the mean.
    for (int p = 0; p < bvh_.count(); ++p) {
        const auto k = static_cast<std::size_t>(p);
        deviation_[k] += bvh_.isFollowed(p) ? bvh_.motion(p).deviation : 2 * bvh_.travel(p);
        travel_[k] += bvh_.travel(p);
    }
    for (TrackedPair* tracked : checked_) {
        tracked->list->travelledBefore += relativeMotionOf(*tracked->list);
        tracked->countedTravel = travelOf(tracked->pair);
    }
    forgetChecked();
}

void BroadPhase::forgetChecked() {
    for (TrackedPair* tracked : checked_) tracked->isChecked = false;
    checked_.clear();
}

// Empties the list. No pair is near until it has approached by the margin [m].
void BroadPhase::restart(CandidateList& list, double margin) const {
    clear(list);
    list.leastTravelBudget = list.leastApproachBudget = 1e300;
    list.margin = margin;
    list.offset = bvh_.motion(list.a).centre - bvh_.motion(list.b).centre;
    list.deviationA = deviation_[static_cast<std::size_t>(list.a)];
    list.deviationB = deviation_[static_cast<std::size_t>(list.b)];
    list.approached = list.travelled = list.relativeMotion;
    list.travelledBefore = 0;
    const LeafMotion &motionA = bvh_.motion(list.a), &motionB = bvh_.motion(list.b);
    list.deformationA = motionA.deformation;
    list.deformationB = motionB.deformation;
    list.referenceA = motionA.reference;
    list.referenceB = motionB.reference;
}

std::uint64_t BroadPhase::bytes() const {
    std::uint64_t sum = lists_.size() * sizeof(CandidateList);
    for (const CandidateList& list : lists_)
        sum += list.pairs.capacity() * (sizeof(CandidatePair) + 2 * sizeof(double));
    return sum;
}

}  // namespace taut::contact
