#include "taut/contact/near_pairs.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "taut/contact/closest.h"
#include "taut/core/parallel.h"

namespace taut::contact {
namespace {

constexpr int atOnce = 8;            // records a task
constexpr double leastMargin = 0.4;  // of the distance kept
constexpr double waysAhead = 4.0;    // like the coming one, for which a list is to last
constexpr double bentShare = 0.4;    // of the largest thickness: patches bent further are remembered anew
constexpr double boxSlack = 0.25;    // of it, by which boxes are found near beforehand
constexpr double flatShare = 0.1;    // of it: what is flat with less to spare is listed nevertheless
constexpr double mostAhead = 8;      // instants for which they are to last
constexpr double mostRoom = 4;       // of that slack, that boxes may grow for it

// Boxes of elements in rows, so that many are tried at once.
struct BoxRows {
    std::vector<int> item;
    std::vector<double> low[3], high[3];
    void clear() {
        item.clear();
        for (int k = 0; k < 3; ++k) {
            low[k].clear();
            high[k].clear();
        }
    }
    void add(int number, const Box& box) {
        item.push_back(number);
        for (int k = 0; k < 3; ++k) {
            low[k].push_back(box.low[k]);
            high[k].push_back(box.high[k]);
        }
    }
};

struct Scratch {
    BoxRows first, second;
    std::vector<long> hits;
};

// [m] between two boxes, at least.
double gapOf(const Box& a, const Box& b) {
    return length(glm::max(dvec3(0.0), glm::max(a.low - b.high, b.low - a.high)));
}

// Calls each(item) for those of the rows that overlap the box.
template <class Each>
void forEachHit(const BoxRows& rows, const Box& box, std::size_t from, std::vector<long>& hits, Each&& each) {
    const std::size_t n = rows.item.size();
    hits.resize(n);
    const double *lx = rows.low[0].data(), *ly = rows.low[1].data(), *lz = rows.low[2].data();
    const double *hx = rows.high[0].data(), *hy = rows.high[1].data(), *hz = rows.high[2].data();
    long* hit = hits.data();
    for (std::size_t i = from; i < n; ++i)
        hit[i] = (lx[i] <= box.high.x) & (box.low.x <= hx[i]) & (ly[i] <= box.high.y) & (box.low.y <= hy[i]) &
                 (lz[i] <= box.high.z) & (box.low.z <= hz[i]);
    for (std::size_t i = from; i < n; ++i)
        if (hit[i] != 0) each(rows.item[i]);
}

}  // namespace

void NearPairs::drop() {
    records_.clear();
    unused_.clear();
    known_.clear();
    awake_.clear();
    roomy_.clear();
    patches_.takeBalls();
    stray_.assign(static_cast<std::size_t>(patches_.count()), 0.0);
}

NearPairs::Record* NearPairs::newRecord(PatchPair pair) {
    if (unused_.empty()) unused_.push_back(&records_.emplace_back());
    Record* record = unused_.back();
    unused_.pop_back();
    std::vector<NearPair> room = std::move(record->pairs);
    *record = {};
    record->pairs = std::move(room);
    record->pairs.clear();
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

bool NearPairs::staysWhereSearched() const {
    if (roomy_.empty()) return false;
    for (int p = 0; p < patches_.count(); ++p) {
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
    for (int p = 0; p < patches_.count(); ++p)
        most = std::max(most, length(patches_.motion(p).way) + patches_.motion(p).stray);
    const double instants = mostAhead * most > mostRoom * room ? mostRoom * room / most : mostAhead;
    roomy_.resize(static_cast<std::size_t>(patches_.count()));
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
            merged_.push_back({pair, newRecord(pair)});
    }
    forgetUntil(~PatchPair{0});
    std::swap(known_, merged_);
}

void NearPairs::find(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    stray_.resize(static_cast<std::size_t>(patches_.count()), 0.0);
    double thickest = 0;
    for (const Surface& surface : elements_.surfaces())
        if (!surface.isRigid) thickest = std::max(thickest, surface.thickness);
    patches_.follow(x0, x1, bentShare * thickest);
    const double room = boxSlack * 2 * thickest;
    if (!staysWhereSearched()) search(room);

    const int count = static_cast<int>(known_.size()), tasks = (count + atOnce - 1) / atOnce;
    core::parallelFor(tasks, [&](int task) {
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, count); ++k) {
            Record& record = *known_[static_cast<std::size_t>(k)].record;
            approach(record);
            record.isFlat = record.isPassing = false;
            record.isNew = record.approached > record.valid;
            if (!record.isNew) continue;
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
    });
    awake_.clear();
    about_.clear();
    for (const auto& [pair, record] : known_) {
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
    slacks_.assign(static_cast<std::size_t>(tasks), room);
    core::parallelFor(tasks, [&](int task) {
        double& least = slacks_[static_cast<std::size_t>(task)];
        for (int k = task * atOnce; k < std::min((task + 1) * atOnce, count); ++k) {
            const Record& record = *known_[static_cast<std::size_t>(k)].record;
            const double unlisted = record.isPassing ? 0.0 : record.valid - record.approached;
            least = std::min({least, unlisted + record.apartAtLeast, watchShare * record.leastKeep});
        }
    });
    slack_ = room;
    for (double least : slacks_) slack_ = std::min(slack_, least);
}

void NearPairs::go(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    patches_.follow(x0, x1);
    for (const Known& known : known_) known.record->way += comingOf(*known.record);
    for (int p = 0; p < patches_.count(); ++p) stray_[static_cast<std::size_t>(p)] += patches_.motion(p).stray;
}

void NearPairs::arrive(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    patches_.correct(moved, x0, x1);
    for (const Known& known : known_) known.record->way += comingOf(*known.record);
    for (int p = 0; p < patches_.count(); ++p) stray_[static_cast<std::size_t>(p)] += patches_.motion(p).stray;
}

// Nothing of it is near until it has come that much nearer [m].
void NearPairs::restart(Record& record, double valid) const {
    record.pairs.clear();
    record.pointPairs = 0;
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

void NearPairs::list(Record& record, std::span<const dvec3> x0) const {
    const Patch &a = patches_[record.a], &b = patches_[record.b];
    const double most = record.most;
    const bool isBond = elements_.shareBond(a.surface, b.surface);
    const double cell = std::min(elements_.shortestEdge(a.surface), elements_.shortestEdge(b.surface));
    // More would list a surface's own neighbours.
    const double own = isBond ? std::min(most, restShare * cell - most) : most;
    const double ahead = std::min(waysAhead * record.coming, std::max(2 * most, record.coming));
    const double margin = std::max({leastMargin * most, own, ahead});
    const double reach = nearShare * most + margin;
    const bool isOne = record.a == record.b;
    const auto at = [&](int i) -> const dvec3& { return x0[static_cast<std::size_t>(i)]; };
    const auto rest = [&](int i) -> const dvec3& { return elements_.rest()[static_cast<std::size_t>(i)]; };

    restart(record, margin);
    const Box &boxA = patches_.motion(record.a).before, &boxB = patches_.motion(record.b).before;

    thread_local Scratch scratch;
    const auto grown = [&](Box box, double by) {
        box.low -= by;
        box.high += by;
        return box;
    };
    const auto tryPoints = [&](const Patch& points, const Patch& triangles, const Box& pointBox,
                               const Box& triangleBox) {
        scratch.first.clear();
        for (int i : points.points) {
            Box box;
            box.add(at(i));
            if (box.overlaps(triangleBox, reach)) scratch.first.add(i, box);
        }
        if (scratch.first.item.empty()) return;
        for (int t : triangles.triangles) {
            const Triangle& triangle = elements_.triangles()[static_cast<std::size_t>(t)];
            if (triangle.isGone) continue;
            const std::array<int, 3>& c = triangle.points;
            Box box;
            for (int i : c) box.add(at(i));
            if (!box.overlaps(pointBox, reach)) continue;
            forEachHit(scratch.first, grown(box, reach), 0, scratch.hits, [&](int i) {
                if (i == c[0] || i == c[1] || i == c[2]) return;
                const OnTriangle on = nearestOnTriangle(at(i), at(c[0]), at(c[1]), at(c[2]));
                const dvec3 apart =
                    at(i) - (on.weights[0] * at(c[0]) + on.weights[1] * at(c[1]) + on.weights[2] * at(c[2]));
                const double square = glm::dot(apart, apart);
                if (square > reach * reach) return;
                double keep = most;
                if (isBond) {
                    const OnTriangle before = nearestOnTriangle(rest(i), rest(c[0]), rest(c[1]), rest(c[2]));
                    keep = std::min(keep, restShare * length(rest(i) - (before.weights[0] * rest(c[0]) +
                                                                        before.weights[1] * rest(c[1]) +
                                                                        before.weights[2] * rest(c[2]))));
                }
                const double d = std::sqrt(square);
                if (d <= nearShare * keep + margin) record.pairs.push_back({i, t, keep, d, d});
            });
        }
    };
    tryPoints(a, b, boxA, boxB);
    if (!isOne) tryPoints(b, a, boxB, boxA);
    std::sort(record.pairs.begin(), record.pairs.end(),
              [](const NearPair& p, const NearPair& q) { return p.b < q.b || (p.b == q.b && p.a < q.a); });
    record.pointPairs = record.pairs.size();

    const auto boxOfEdge = [&](int e) {
        const Edge& edge = elements_.edges()[static_cast<std::size_t>(e)];
        Box box;
        box.add(at(edge.a));
        box.add(at(edge.b));
        return box;
    };
    const auto gather = [&](const Patch& patch, const Box& other, BoxRows& rows) {
        rows.clear();
        for (int e : patch.edges) {
            if (elements_.edges()[static_cast<std::size_t>(e)].isGone) continue;
            const Box box = boxOfEdge(e);
            if (box.overlaps(other, reach)) rows.add(e, box);
        }
    };
    gather(b, boxA, scratch.second);
    if (!isOne) gather(a, boxB, scratch.first);
    const BoxRows& firsts = isOne ? scratch.second : scratch.first;
    for (std::size_t k = 0; k < firsts.item.size(); ++k) {
        const int e = firsts.item[k];
        const Edge& first = elements_.edges()[static_cast<std::size_t>(e)];
        forEachHit(scratch.second, grown(boxOfEdge(e), reach), isOne ? k + 1 : 0, scratch.hits, [&](int f) {
            const Edge& second = elements_.edges()[static_cast<std::size_t>(f)];
            if (first.a == second.a || first.a == second.b || first.b == second.a || first.b == second.b) return;
            const OnSegments on = nearestOnSegments(at(first.a), at(first.b), at(second.a), at(second.b));
            const dvec3 apart = at(first.a) + on.s * (at(first.b) - at(first.a)) -
                                (at(second.a) + on.t * (at(second.b) - at(second.a)));
            const double square = glm::dot(apart, apart);
            if (square > reach * reach) return;
            double keep = most;
            if (isBond) {
                const OnSegments before =
                    nearestOnSegments(rest(first.a), rest(first.b), rest(second.a), rest(second.b));
                keep =
                    std::min(keep, restShare * length(rest(first.a) + before.s * (rest(first.b) - rest(first.a)) -
                                                      (rest(second.a) + before.t * (rest(second.b) - rest(second.a)))));
            }
            const double d = std::sqrt(square);
            if (d <= nearShare * keep + margin) record.pairs.push_back({std::min(e, f), std::max(e, f), keep, d, d});
        });
    }
    std::sort(record.pairs.begin() + static_cast<std::ptrdiff_t>(record.pointPairs), record.pairs.end(),
              [](const NearPair& p, const NearPair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
    for (const NearPair& pair : record.pairs) {
        record.leastKeep = std::min(record.leastKeep, pair.distance);
        record.asleepTravelled = std::min(record.asleepTravelled, pair.atFirst - nearShare * pair.distance);
    }
}

std::uint64_t NearPairs::bytes() const {
    std::uint64_t sum = records_.size() * sizeof(Record);
    for (const Record& record : records_) sum += record.pairs.capacity() * sizeof(NearPair);
    return sum;
}

}  // namespace taut::contact
