// Makes the candidate list of two leaves. First it tests the boxes of elements, many at once. Then it measures the
// distances of those that overlap, many at once.
//
// Elements of one body may be closer at rest than their thickness. They keep at most restShare of their distance at
// rest. So pairs of one body are measured twice, at x0 and at rest.
#include <algorithm>
#include <array>

#include "taut/contact/broad_phase.h"
#include "taut/contact/closest_batch.h"

namespace taut::contact {
namespace {

constexpr double leastMargin = 0.4;    // of the thickness
constexpr double instantsAhead = 4.0;  // a list should last for so many instants like this one

// Boxes of elements, one row for each coordinate, for the kernel that tests many at once.
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
    void add(int number, const core::Aabb& box) {
        item.push_back(number);
        for (int k = 0; k < 3; ++k) {
            low[k].push_back(box.low[k]);
            high[k].push_back(box.high[k]);
        }
    }
};

struct MeasuredPair {
    CandidatePair pair;
    double distance;  // [m]
};

struct Scratch {
    BoxRows first, second;
    std::vector<int> hits;
    std::vector<CandidatePair> overlapping;
    ClosestBatch batch;
    std::vector<MeasuredPair> inReach;
};

// What to look for between two leaves.
struct Query {
    const Elements& elements;
    std::span<const dvec3> x0;  // (points) [m]
    ClosestKernels kernels;
    double thickness;  // [m] sum of both surfaces' thicknesses
    double margin;     // [m] of the list
    double reach;      // [m] largest distance of a pair in the list
    bool isBond;       // both surfaces belong to one body
    bool isOne;        // both leaves are the same leaf

    const dvec3& at(int i) const { return x0[static_cast<std::size_t>(i)]; }
    const Triangle& triangle(int t) const { return elements.triangles()[static_cast<std::size_t>(t)]; }
    const Edge& edge(int e) const { return elements.edges()[static_cast<std::size_t>(e)]; }
    core::Aabb boxOfEdge(int e) const {
        core::Aabb box;
        box.add(at(edge(e).a));
        box.add(at(edge(e).b));
        return box;
    }
};

// Calls each(item) for the rows from `from` on that overlap the box.
template <class Each>
void forEachHit(const ClosestKernels& kernels, const BoxRows& rows, const core::Aabb& box, std::size_t from,
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

core::Aabb grown(core::Aabb box, double by) {
    box.grow(by);
    return box;
}

// Finds points of one leaf and triangles of the other whose boxes are within reach -> scratch.overlapping.
void overlapPoints(const Query& query, const BvhLeaf& ofPoints, const BvhLeaf& ofTriangles, const core::Aabb& pointBox,
                   const core::Aabb& triangleBox, Scratch& scratch) {
    scratch.first.clear();
    for (int i : ofPoints.points) {
        core::Aabb box;
        box.add(query.at(i));
        if (box.overlaps(triangleBox, query.reach)) scratch.first.add(i, box);
    }
    if (scratch.first.item.empty()) return;
    for (int t : ofTriangles.triangles) {
        const Triangle& triangle = query.triangle(t);
        if (triangle.isGone) continue;
        const std::array<int, 3>& c = triangle.points;
        core::Aabb box;
        for (int i : c) box.add(query.at(i));
        if (!box.overlaps(pointBox, query.reach)) continue;
        forEachHit(query.kernels, scratch.first, grown(box, query.reach), 0, scratch.hits, [&](int i) {
            if (i != c[0] && i != c[1] && i != c[2]) scratch.overlapping.push_back({i, t, query.thickness});
        });
    }
}

// Finds edges of both leaves whose boxes are within reach -> scratch.overlapping.
void overlapEdges(const Query& query, const BvhLeaf& a, const BvhLeaf& b, const core::Aabb& boxA,
                  const core::Aabb& boxB, Scratch& scratch) {
    const auto gather = [&](const BvhLeaf& leaf, const core::Aabb& other, BoxRows& rows) {
        rows.clear();
        for (int e : leaf.edges) {
            if (query.edge(e).isGone) continue;
            const core::Aabb box = query.boxOfEdge(e);
            if (box.overlaps(other, query.reach)) rows.add(e, box);
        }
    };
    gather(b, boxA, scratch.second);
    if (!query.isOne) gather(a, boxB, scratch.first);
    const BoxRows& firsts = query.isOne ? scratch.second : scratch.first;
    for (std::size_t k = 0; k < firsts.item.size(); ++k) {
        const int e = firsts.item[k];
        const Edge& first = query.edge(e);
        const core::Aabb box = grown(query.boxOfEdge(e), query.reach);
        forEachHit(query.kernels, scratch.second, box, query.isOne ? k + 1 : 0, scratch.hits, [&](int f) {
            const Edge& second = query.edge(f);
            if (first.a != second.a && first.a != second.b && first.b != second.a && first.b != second.b)
                scratch.overlapping.push_back({std::min(e, f), std::max(e, f), query.thickness});
        });
    }
}

// Measures scratch.overlapping, and appends the pairs within the margin to the list, sorted by isBefore.
// pointsOf(pair): the four points that the kernel gets.
template <class PointsOf, class IsBefore>
void appendInReach(const Query& query, void (*kernel)(ClosestLanes&, int), PointsOf&& pointsOf, IsBefore&& isBefore,
                   Scratch& scratch, BroadPhase::CandidateList& list) {
    const auto measure = [&](std::span<const dvec3> x) {
        scratch.batch.clear();
        for (const CandidatePair& pair : scratch.overlapping) {
            const std::array<int, 4> i = pointsOf(pair);
            scratch.batch.add(x[static_cast<std::size_t>(i[0])], x[static_cast<std::size_t>(i[1])],
                              x[static_cast<std::size_t>(i[2])], x[static_cast<std::size_t>(i[3])]);
        }
        scratch.batch.solve(kernel);
    };

    // The distances at x0. Only pairs within reach go on.
    measure(query.x0);
    scratch.inReach.clear();
    std::size_t within = 0;
    for (std::size_t k = 0; k < scratch.overlapping.size(); ++k) {
        const double distance = scratch.batch.distance(static_cast<int>(k));
        if (distance > query.reach) continue;
        scratch.inReach.push_back({scratch.overlapping[k], distance});
        scratch.overlapping[within++] = scratch.overlapping[k];
    }
    scratch.overlapping.resize(within);

    // The distances at rest limit the thickness of pairs of one body.
    if (query.isBond) {
        measure(query.elements.rest());
        for (std::size_t k = 0; k < within; ++k) {
            double& thickness = scratch.inReach[k].pair.thickness;
            thickness = std::min(thickness, restShare * scratch.batch.distance(static_cast<int>(k)));
        }
    }
    scratch.overlapping.clear();

    // The first budget of a pair is its distance, less what counts as near.
    std::sort(scratch.inReach.begin(), scratch.inReach.end(),
              [&](const MeasuredPair& p, const MeasuredPair& q) { return isBefore(p.pair, q.pair); });
    for (const MeasuredPair& measured : scratch.inReach) {
        const double left = measured.distance - nearShare * measured.pair.thickness;
        if (left > query.margin) continue;
        list.pairs.push_back(measured.pair);
        list.travelBudget.push_back(left);
        list.leastThickness = std::min(list.leastThickness, measured.pair.thickness);
        list.leastTravelBudget = std::min(list.leastTravelBudget, left);
    }
}

}  // namespace

void BroadPhase::makeList(CandidateList& list, std::span<const dvec3> x0) const {
    const BvhLeaf &a = bvh_[list.a], &b = bvh_[list.b];
    const double thickness = list.thickness;
    const bool isBond = elements_.shareBond(a.surface, b.surface);

    // The margin is a share of the thickness, and more if the leaves move fast. Within one body it stays so small that
    // an element does not list its neighbours.
    const double cell = std::min(elements_.shortestEdge(a.surface), elements_.shortestEdge(b.surface));
    const double slow = isBond ? std::min(thickness, restShare * cell - thickness) : thickness;
    const double fast = std::min(instantsAhead * list.relativeMotion, std::max(2 * thickness, list.relativeMotion));
    const double margin = std::max({leastMargin * thickness, slow, fast});
    restart(list, margin);

    const ClosestKernels kernels = closestKernels();
    const double reach = nearShare * thickness + margin;
    const Query query{elements_, x0, kernels, thickness, margin, reach, isBond, list.a == list.b};
    const core::Aabb &boxA = bvh_.motion(list.a).before, &boxB = bvh_.motion(list.b).before;
    thread_local Scratch scratch;
    scratch.overlapping.clear();

    // Pairs of points and triangles first.
    overlapPoints(query, a, b, boxA, boxB, scratch);
    if (!query.isOne) overlapPoints(query, b, a, boxB, boxA, scratch);
    appendInReach(
        query, kernels.onTriangles,
        [&](const CandidatePair& pair) -> std::array<int, 4> {
            const std::array<int, 3>& c = query.triangle(pair.b).points;
            return {pair.a, c[0], c[1], c[2]};
        },
        [](const CandidatePair& p, const CandidatePair& q) { return p.b < q.b || (p.b == q.b && p.a < q.a); }, scratch,
        list);
    list.pointPairs = list.pairs.size();

    // Then pairs of edges.
    overlapEdges(query, a, b, boxA, boxB, scratch);
    appendInReach(
        query, kernels.onSegments,
        [&](const CandidatePair& pair) -> std::array<int, 4> {
            const Edge &first = query.edge(pair.a), &second = query.edge(pair.b);
            return {first.a, first.b, second.a, second.b};
        },
        [](const CandidatePair& p, const CandidatePair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); }, scratch,
        list);
    list.approachBudget = list.travelBudget;
}

}  // namespace taut::contact
