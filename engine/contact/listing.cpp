// Which pairs of two patches are within reach.
#include <algorithm>
#include <cmath>

#include "taut/contact/closest.h"
#include "taut/contact/near_pairs.h"

namespace taut::contact {
namespace {

constexpr double leastMargin = 0.4;  // of the distance kept
constexpr double waysAhead = 4.0;    // like the coming one, for which a list is to last

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

struct Listed {
    NearPair pair;
    double left;  // [m] until it is near
};

struct Scratch {
    std::vector<Listed> pairs;
    BoxRows first, second;
    std::vector<long> hits;
};

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
    scratch.pairs.clear();
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
                if (d <= nearShare * keep + margin) scratch.pairs.push_back({{i, t, keep}, d - nearShare * keep});
            });
        }
    };
    tryPoints(a, b, boxA, boxB);
    if (!isOne) tryPoints(b, a, boxB, boxA);
    const auto take = [&](auto&& isBefore) {
        std::sort(scratch.pairs.begin(), scratch.pairs.end(), isBefore);
        for (const Listed& listed : scratch.pairs) {
            record.pairs.push_back(listed.pair);
            record.nearTravelled.push_back(listed.left);
            record.leastKeep = std::min(record.leastKeep, listed.pair.distance);
            record.asleepTravelled = std::min(record.asleepTravelled, listed.left);
        }
        scratch.pairs.clear();
    };
    take([](const Listed& p, const Listed& q) {
        return p.pair.b < q.pair.b || (p.pair.b == q.pair.b && p.pair.a < q.pair.a);
    });
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
            if (d <= nearShare * keep + margin)
                scratch.pairs.push_back({{std::min(e, f), std::max(e, f), keep}, d - nearShare * keep});
        });
    }
    take([](const Listed& p, const Listed& q) {
        return p.pair.a < q.pair.a || (p.pair.a == q.pair.a && p.pair.b < q.pair.b);
    });
    record.nearApproached = record.nearTravelled;
}

}  // namespace taut::contact
