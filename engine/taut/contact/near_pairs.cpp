#include "taut/contact/near_pairs.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "taut/contact/closest.h"
#include "taut/core/parallel.h"

namespace taut::contact {
namespace {

constexpr int atOnce = 8;          // records a task
constexpr double bentShare = 0.4;  // of the largest thickness: patches bent further are remembered anew
constexpr double roomShare = 0.5;  // of it: room between boxes that are found near beforehand
constexpr double flatShare = 0.1;  // of the thickness: what is flat with less to spare is listed nevertheless
constexpr double mostAhead = 8;    // instants for which a search is to last
constexpr double mostRoom = 4;     // of that room, that boxes may grow for it

// [m] between two boxes, at least.
double gapOf(const Box& a, const Box& b) {
    return length(glm::max(dvec3(0.0), glm::max(a.low - b.high, b.low - a.high)));
}

}  // namespace

void NearPairs::drop() {
    records_.clear();
    unused_.clear();
    known_.clear();
    awake_.clear();
    roomy_.clear();
    patches_.takeBalls();
    looked_.clear();
    stray_.assign(static_cast<std::size_t>(patches_.count()), 0.0);
    gone_.assign(static_cast<std::size_t>(patches_.count()), 0.0);
}

void NearPairs::clear(Record& record) {
    record.pairs.clear();
    record.nearTravelled.clear();
    record.nearApproached.clear();
    record.pointPairs = 0;
}

NearPairs::Record* NearPairs::newRecord(PatchPair pair) {
    if (unused_.empty()) unused_.push_back(&records_.emplace_back());
    Record* record = unused_.back();
    unused_.pop_back();
    Record fresh;
    fresh.pairs = std::move(record->pairs);
    fresh.nearTravelled = std::move(record->nearTravelled);
    fresh.nearApproached = std::move(record->nearApproached);
    *record = std::move(fresh);
    clear(*record);
    record->a = lowOf(pair);
    record->b = highOf(pair);
    record->about = patches_.about(record->a, record->b);
    const int a = patches_[record->a].surface, b = patches_[record->b].surface;
    record->most = elements_.surface(a).thickness + elements_.surface(b).thickness;
    if (!elements_.shareBond(a, b))
        record->apartAtLeast = record->most;
    else if (a == b && patches_.isPlane(a))
        record->apartAtLeast = std::min(record->most, restShare * patches_.leastAltitude(a));
    return record;
}

double NearPairs::comingOf(const Record& record) const {
    const PatchMotion &a = patches_.motion(record.a), &b = patches_.motion(record.b);
    return (record.a == record.b ? 0.0 : length(a.way - b.way)) + a.stray + b.stray;
}

void NearPairs::approach(Record& record) const {
    const PatchMotion &a = patches_.motion(record.a), &b = patches_.motion(record.b);
    const double strayA = stray_[static_cast<std::size_t>(record.a)] - record.strayA;
    const double strayB = stray_[static_cast<std::size_t>(record.b)] - record.strayB;
    const bool isOne = record.a == record.b;
    record.coming = comingOf(record);
    // Between the means, before and after; and of the points about them.
    double between = 0;
    if (!isOne) {
        const dvec3 before = a.centre - b.centre - record.apart, after = before + a.way - b.way;
        between = std::sqrt(std::max(glm::dot(before, before), glm::dot(after, after)));
    }
    const double ownA = strayA + a.stray, ownB = strayB + b.stray;
    const double bentA = a.times == record.timesA ? a.bent + record.bentA : ownA;
    const double bentB = b.times == record.timesB ? b.bent + record.bentB : ownB;
    record.approached = between + std::min(ownA, bentA) + std::min(ownB, bentB);
    record.travelled = record.way + record.coming;
}

// Whether all of one patch stays further from all of the other than any pair of them is near, along the way between
// their middles, before and after, and so in between.
bool NearPairs::passesBy(const Record& record, std::span<const dvec3> x0, std::span<const dvec3> x1) const {
    const PatchMotion &a = patches_.motion(record.a), &b = patches_.motion(record.b);
    const dvec3 between = a.centre - b.centre + 0.5 * (a.way - b.way);
    const double size = length(between);
    if (!(size > 0)) return false;
    const dvec3 axis = between / size;
    for (const auto& x : {x0, std::span<const dvec3>(x1)}) {
        double low = 1e300, high = -1e300;
        for (int i : patches_[record.a].corners) low = std::min(low, glm::dot(axis, x[static_cast<std::size_t>(i)]));
        for (int i : patches_[record.b].corners) high = std::max(high, glm::dot(axis, x[static_cast<std::size_t>(i)]));
        if (!(low - high > nearShare * record.most)) return false;
    }
    return true;
}

bool NearPairs::staysWhereSearched(std::span<const dvec3> x0, std::span<const dvec3> x1, double bent) {
    if (roomy_.empty()) return false;
    patchList_.clear();
    for (int p = 0; p < patches_.count(); ++p) {
        const auto k = static_cast<std::size_t>(p);
        if (gone_[k] + patches_.going(p) - goneThen_[k] > lasting_) patchList_.push_back(p);
    }
    patches_.follow(patchList_, x0, x1, bent);
    for (int p : patchList_) {
        const Box &box = patches_.motion(p).box, &roomy = roomy_[static_cast<std::size_t>(p)];
        if (!(box.low.x >= roomy.low.x && box.low.y >= roomy.low.y && box.low.z >= roomy.low.z &&
              box.high.x <= roomy.high.x && box.high.y <= roomy.high.y && box.high.z <= roomy.high.z))
            return false;
    }
    return true;
}

// For as many instants like this one as pay.
void NearPairs::search(double room) {
    double most = 0;
    for (int p = 0; p < patches_.count(); ++p) most = std::max(most, patches_.going(p));
    const double instants = mostAhead * most > mostRoom * room ? mostRoom * room / most : mostAhead;
    roomy_.resize(static_cast<std::size_t>(patches_.count()));
    goneThen_ = gone_;
    lasting_ = instants < 1 ? 0.0 : room;
    for (int p = 0; p < patches_.count(); ++p) {
        const PatchMotion& motion = patches_.motion(p);
        Box& roomy = roomy_[static_cast<std::size_t>(p)];
        roomy = motion.box;
        if (instants < 1) continue;
        const dvec3 way = instants * motion.way;
        const double aside = room + instants * motion.stray;
        roomy.low += glm::min(way, dvec3(0.0)) - aside;
        roomy.high += glm::max(way, dvec3(0.0)) + aside;
    }
    patches_.findNear(roomy_, room, found_);

    merged_.clear();
    auto old = known_.begin();
    const auto forgetUntil = [&](PatchPair pair) {
        for (; old != known_.end() && old->pair < pair; ++old) unused_.push_back(old->record);
    };
    for (PatchPair pair : found_) {
        forgetUntil(pair);
        if (old != known_.end() && old->pair == pair)
            merged_.push_back(*old++);
        else
            merged_.push_back({pair, newRecord(pair), -1, 0, goneOf(pair)});
    }
    forgetUntil(~PatchPair{0});
    std::swap(known_, merged_);
}

double NearPairs::goneOf(PatchPair pair) const {
    return gone_[static_cast<std::size_t>(lowOf(pair))] + gone_[static_cast<std::size_t>(highOf(pair))];
}

// Whether the list of a record holds in this instant, or need not.
void NearPairs::look(Known& known, std::span<const dvec3> x0, std::span<const dvec3> x1) const {
    Record& record = *known.record;
    const double gone = goneOf(known.pair);
    record.way += gone - known.counted;
    known.counted = gone;
    known.quiet = -1;
    approach(record);
    record.isFlat = record.isPassing = false;
    record.isNew = record.approached > record.valid;
    if (!record.isNew) return;
    const double between = gapOf(patches_.motion(record.a).before, patches_.motion(record.b).before);
    const double apart = between - nearShare * record.most;
    if (apart > record.coming) {
        record.isNew = false;
        restart(record, apart);
    } else if (apart > 0 && passesBy(record, x0, x1)) {
        record.isNew = false;
        record.isPassing = true;
    }
}

void NearPairs::find(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    stray_.resize(static_cast<std::size_t>(patches_.count()), 0.0);
    gone_.resize(static_cast<std::size_t>(patches_.count()), 0.0);
    double thickest = 0;
    for (const Surface& surface : elements_.surfaces())
        if (!surface.isRigid) thickest = std::max(thickest, surface.thickness);
    const double room = roomShare * thickest, bent = bentShare * thickest;
    patches_.start(x0, x1);
    if (!staysWhereSearched(x0, x1, bent)) {
        patches_.followAll(x0, x1, bent);
        search(room);
    }

    const int count = static_cast<int>(known_.size()), tasks = (count + atOnce - 1) / atOnce;
    isLooked_.resize(known_.size());
    slacks_.assign(static_cast<std::size_t>(tasks), room);
    core::parallelFor(tasks, [&](int task) {
        double& slack = slacks_[static_cast<std::size_t>(task)];
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, count); ++k) {
            const Known& known = known_[static_cast<std::size_t>(k)];
            const double going = patches_.going(lowOf(known.pair)) + patches_.going(highOf(known.pair));
            const double left = known.quiet - (goneOf(known.pair) + going - known.since);
            isLooked_[static_cast<std::size_t>(k)] = left > 0 ? 0 : 1;
            if (left > 0) slack = std::min({slack, left + known.apartAtLeast, watchShare * known.leastKeep});
        }
    });
    looked_.clear();
    patchList_.clear();
    for (std::size_t k = 0; k < known_.size(); ++k) {
        if (isLooked_[k] == 0) continue;
        looked_.push_back(&known_[k]);
        patchList_.push_back(lowOf(known_[k].pair));
        patchList_.push_back(highOf(known_[k].pair));
    }
    patches_.follow(patchList_, x0, x1, bent);
    const int looked = static_cast<int>(looked_.size());
    core::parallelFor((looked + atOnce - 1) / atOnce, [&](int task) {
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, looked); ++k)
            look(*looked_[static_cast<std::size_t>(k)], x0, x1);
    });
    awake_.clear();
    about_.clear();
    for (const Known* known : looked_) {
        Record* record = known->record;
        if (record->isPassing) continue;
        if (!record->isNew && record->travelled < record->asleepTravelled &&
            record->approached < record->asleepApproached)
            continue;
        awake_.push_back(record);
        about_.insert(about_.end(), record->about.begin(), record->about.end());
    }
    patches_.measureFlatness(about_, x0, x1);
    std::atomic<std::size_t> made{0};
    const int stirring = static_cast<int>(awake_.size());
    core::parallelFor((stirring + atOnce - 1) / atOnce, [&](int task) {
        std::size_t own = 0;
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, stirring); ++k) {
            Record& record = *awake_[static_cast<std::size_t>(k)];
            const int surface = patches_[record.a].surface;
            const double more = patches_.flatness(record.about) - patches_.enough(surface);
            const double apart = more * patches_.leastAltitude(surface);
            record.isFlat = more >= 0;
            if (record.isFlat && apart >= flatShare * elements_.surface(surface).thickness) {
                restart(record, apart);
            } else if (record.isNew) {
                list(record, x0);
                ++own;
            }
        }
        made += own;
    });
    listed_ += made;
    slack_ = room;
    for (double slack : slacks_) slack_ = std::min(slack_, slack);
    for (const Known* known : looked_) {
        const Record& record = *known->record;
        const double unlisted = record.isPassing ? 0.0 : record.valid - record.approached;
        slack_ = std::min({slack_, unlisted + record.apartAtLeast, watchShare * record.leastKeep});
    }
}

void NearPairs::go(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    patches_.start(x0, x1);
    looked_.clear();
    addWays();
}

void NearPairs::arrive(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    patches_.correct(moved, x0, x1);
    addWays();
}

// Those that were looked at know how far they have come nearer, the others only how far their patches have gone.
void NearPairs::addWays() {
    for (Known* known : looked_) {
        const Record& record = *known->record;
        known->since = goneOf(known->pair);
        known->quiet = std::min({record.valid - record.approached, record.asleepTravelled - record.travelled,
                                 record.asleepApproached - record.approached});
        known->apartAtLeast = record.apartAtLeast;
        known->leastKeep = record.leastKeep;
    }
    for (int p = 0; p < patches_.count(); ++p) {
        const auto k = static_cast<std::size_t>(p);
        stray_[k] += patches_.isFollowed(p) ? patches_.motion(p).stray : 2 * patches_.going(p);
        gone_[k] += patches_.going(p);
    }
    for (Known* known : looked_) {
        known->record->way += comingOf(*known->record);
        known->counted = goneOf(known->pair);
    }
    looked_.clear();
}

// Nothing of it is near until it has come that much nearer [m].
void NearPairs::restart(Record& record, double valid) const {
    clear(record);
    record.asleepTravelled = record.asleepApproached = 1e300;
    record.leastKeep = 1e300;
    record.valid = valid;
    record.apart = patches_.motion(record.a).centre - patches_.motion(record.b).centre;
    record.strayA = stray_[static_cast<std::size_t>(record.a)];
    record.strayB = stray_[static_cast<std::size_t>(record.b)];
    record.approached = record.travelled = record.coming;
    record.way = 0;
    const PatchMotion &motionA = patches_.motion(record.a), &motionB = patches_.motion(record.b);
    record.bentA = motionA.bent;
    record.bentB = motionB.bent;
    record.timesA = motionA.times;
    record.timesB = motionB.times;
}

std::uint64_t NearPairs::bytes() const {
    std::uint64_t sum = records_.size() * sizeof(Record);
    for (const Record& record : records_) sum += record.pairs.capacity() * (sizeof(NearPair) + 2 * sizeof(double));
    return sum;
}

}  // namespace taut::contact
