// Which pairs of two leaves are within reach.
#include <algorithm>
#include <array>

#include "taut/contact/broad_phase.h"
#include "taut/contact/closest_batch.h"

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
    CandidatePair pair;
    double distance;  // [m]
};

struct Scratch {
    BoxRows first, second;
    std::vector<int> hits;
    std::vector<CandidatePair> tried;
    ClosestBatch batch;
    std::vector<Listed> listed;
};

// Calls each(item) for those of the rows, from one on, that overlap the box.
template <class Each>
void forEachHit(const ClosestKernels& kernels, const BoxRows& rows, const Box& box, std::size_t from,
                std::vector<int>& hits, Each&& each) {
    hits.resize(rows.item.size());
    BoxLanes lanes;
    lanes.n = static_cast<int>(rows.item.size() - from);
    for (int k = 0; k < 3; ++k) {
        lanes.low[k] = rows.low[k].data() + from;
        lanes.high[k] = rows.high[k].data() + from;
    }
    const int count = kernels.findOverlapping(lanes, &box.low[0], &box.high[0], hits.data());
    for (int n = 0; n < count; ++n) each(rows.item[from + static_cast<std::size_t>(hits[static_cast<std::size_t>(n)])]);
}

Box grown(Box box, double by) {
    box.low -= by;
    box.high += by;
    return box;
}

}  // namespace

void BroadPhase::makeList(CandidateList& list, std::span<const dvec3> x0) const {
    const BvhLeaf &a = bvh_[list.a], &b = bvh_[list.b];
    const double most = list.most;
    const bool isBond = elements_.shareBond(a.surface, b.surface);
    const double cell = std::min(elements_.shortestEdge(a.surface), elements_.shortestEdge(b.surface));
    // More would list a surface's own neighbours.
    const double own = isBond ? std::min(most, restShare * cell - most) : most;
    const double ahead = std::min(waysAhead * list.coming, std::max(2 * most, list.coming));
    const double margin = std::max({leastMargin * most, own, ahead});
    const double reach = nearShare * most + margin;
    const bool isOne = list.a == list.b;
    const std::span<const dvec3> rest(elements_.rest());
    const auto at = [&](int i) -> const dvec3& { return x0[static_cast<std::size_t>(i)]; };
    const auto triangleAt = [&](int t) -> const Triangle& {
        return elements_.triangles()[static_cast<std::size_t>(t)];
    };
    const auto edgeAt = [&](int e) -> const Edge& { return elements_.edges()[static_cast<std::size_t>(e)]; };

    restart(list, margin);
    const Box &boxA = bvh_.motion(list.a).before, &boxB = bvh_.motion(list.b).before;

    const ClosestKernels kernels = closestKernels();
    thread_local Scratch scratch;
    scratch.tried.clear();
    // Measures what was tried, and takes what is within reach in an order of its own.
    const auto measure = [&](void (*kernel)(ClosestLanes&, int), auto&& placesOf, auto&& isBefore) {
        const auto solve = [&](std::span<const dvec3> x) {
            scratch.batch.clear();
            for (const CandidatePair& pair : scratch.tried) {
                const std::array<int, 4> i = placesOf(pair);
                scratch.batch.add(x[static_cast<std::size_t>(i[0])], x[static_cast<std::size_t>(i[1])],
                                  x[static_cast<std::size_t>(i[2])], x[static_cast<std::size_t>(i[3])]);
            }
            scratch.batch.solve(kernel);
        };
        solve(x0);
        scratch.listed.clear();
        std::size_t within = 0;
        for (std::size_t k = 0; k < scratch.tried.size(); ++k) {
            const double distance = scratch.batch.distance(static_cast<int>(k));
            if (distance > reach) continue;
            scratch.listed.push_back({scratch.tried[k], distance});
            scratch.tried[within++] = scratch.tried[k];
        }
        scratch.tried.resize(within);
        if (isBond) {
            solve(rest);
            for (std::size_t k = 0; k < within; ++k) {
                double& thickness = scratch.listed[k].pair.thickness;
                thickness = std::min(thickness, restShare * scratch.batch.distance(static_cast<int>(k)));
            }
        }
        scratch.tried.clear();
        std::sort(
            scratch.listed.begin(), scratch.listed.end(),
            [&](const Listed& p, const Listed& q) { return isBefore(p.pair, q.pair); });
        for (const Listed& listed : scratch.listed) {
            const double left = listed.distance - nearShare * listed.pair.thickness;
            if (left > margin) continue;
            list.pairs.push_back(listed.pair);
            list.nearTravelled.push_back(left);
            list.leastThickness = std::min(list.leastThickness, listed.pair.thickness);
            list.asleepTravelled = std::min(list.asleepTravelled, left);
        }
    };

    const auto tryPoints = [&](const BvhLeaf& points, const BvhLeaf& triangles, const Box& pointBox,
                               const Box& triangleBox) {
        scratch.first.clear();
        for (int i : points.points) {
            Box box;
            box.add(at(i));
            if (box.overlaps(triangleBox, reach)) scratch.first.add(i, box);
        }
        if (scratch.first.item.empty()) return;
        for (int t : triangles.triangles) {
            const Triangle& triangle = triangleAt(t);
            if (triangle.isGone) continue;
            const std::array<int, 3>& c = triangle.points;
            Box box;
            for (int i : c) box.add(at(i));
            if (!box.overlaps(pointBox, reach)) continue;
            forEachHit(kernels, scratch.first, grown(box, reach), 0, scratch.hits, [&](int i) {
                if (i != c[0] && i != c[1] && i != c[2]) scratch.tried.push_back({i, t, most});
            });
        }
    };
    tryPoints(a, b, boxA, boxB);
    if (!isOne) tryPoints(b, a, boxB, boxA);
    measure(
        kernels.onTriangles,
        [&](const CandidatePair& pair) -> std::array<int, 4> {
            const std::array<int, 3>& c = triangleAt(pair.b).points;
            return {pair.a, c[0], c[1], c[2]};
        },
        [](const CandidatePair& p, const CandidatePair& q) { return p.b < q.b || (p.b == q.b && p.a < q.a); });
    list.pointPairs = list.pairs.size();

    const auto boxOfEdge = [&](int e) {
        Box box;
        box.add(at(edgeAt(e).a));
        box.add(at(edgeAt(e).b));
        return box;
    };
    const auto gather = [&](const BvhLeaf& leaf, const Box& other, BoxRows& rows) {
        rows.clear();
        for (int e : leaf.edges) {
            if (edgeAt(e).isGone) continue;
            const Box box = boxOfEdge(e);
            if (box.overlaps(other, reach)) rows.add(e, box);
        }
    };
    gather(b, boxA, scratch.second);
    if (!isOne) gather(a, boxB, scratch.first);
    const BoxRows& firsts = isOne ? scratch.second : scratch.first;
    for (std::size_t k = 0; k < firsts.item.size(); ++k) {
        const int e = firsts.item[k];
        const Edge& first = edgeAt(e);
        forEachHit(kernels, scratch.second, grown(boxOfEdge(e), reach), isOne ? k + 1 : 0, scratch.hits, [&](int f) {
            const Edge& second = edgeAt(f);
            if (first.a != second.a && first.a != second.b && first.b != second.a && first.b != second.b)
                scratch.tried.push_back({std::min(e, f), std::max(e, f), most});
        });
    }
    measure(
        kernels.onSegments,
        [&](const CandidatePair& pair) -> std::array<int, 4> {
            const Edge &first = edgeAt(pair.a), &second = edgeAt(pair.b);
            return {first.a, first.b, second.a, second.b};
        },
        [](const CandidatePair& p, const CandidatePair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
    list.nearApproached = list.nearTravelled;
}

}  // namespace taut::contact
