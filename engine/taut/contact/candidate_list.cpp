// Makes the candidate list of two leaves. First it tests the boxes of elements, many at once. Then it measures the
// distances of those that overlap, many at once.
//
// Elements of one body may be closer at rest than their thickness. They keep at most restShare of their distance at
// rest. So pairs of one body are measured twice, at x0 and at rest.
#include <algorithm>
#include <array>
#include <utility>

#include "taut/contact/broad_phase.h"
#include "taut/contact/closest_batch.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr double leastMargin = 0.4;  // of the thickness
constexpr int boxedAtOnce = 16;      // leaves per task
constexpr double blocksAhead = 4.0;  // a list should last for so many blocks like this one

struct MeasuredPair {
    CandidatePair pair;
    double distance;  // [m]
};

struct Scratch {
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

    const Triangle& triangle(int t) const { return elements.triangles()[static_cast<std::size_t>(t)]; }
    const Edge& edge(int e) const { return elements.edges()[static_cast<std::size_t>(e)]; }
};

// Measures scratch.overlapping, and appends the pairs within the margin to the list, sorted by isBefore.
template <class IsBefore>
void appendInReach(const Query& query, void (*kernel)(ClosestLanes&, int), IsBefore&& isBefore, Scratch& scratch,
                   BroadPhase::CandidateList& list) {
    const auto measure = [&](std::span<const dvec3> x) {
        scratch.batch.clear();
        for (const CandidatePair& pair : scratch.overlapping) scratch.batch.add(x, pair.points);
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
        list.leastTravelBudget = std::min(list.leastTravelBudget, left);
    }
}

}  // namespace

// Of the leaves of lists that expired: boxes of their elements at x0, which many lists need -> boxes_.
void BroadPhase::findBoxes(std::span<const dvec3> x0) {
    boxes_.resize(static_cast<std::size_t>(bvh_.count()));
    leafList_.clear();
    for (const CandidateList* list : due_)
        if (list->isExpired) leafList_.insert(leafList_.end(), {list->a, list->b});
    std::erase_if(leafList_, [&](int p) { return std::exchange(hasBoxes_[static_cast<std::size_t>(p)], 1) != 0; });
    if (leafList_.empty()) return;
    if (pointBoxes_.empty()) findPointBoxes(x0, pointBoxes_);
    core::parallelFor(static_cast<int>(leafList_.size()), boxedAtOnce, [&](int k) {
        const int number = leafList_[static_cast<std::size_t>(k)];
        boxes_[static_cast<std::size_t>(number)].find(elements_, bvh_[number], pointBoxes_);
    });
}

void BroadPhase::makeList(CandidateList& list, std::span<const dvec3> x0) const {
    const BvhLeaf &a = bvh_[list.a], &b = bvh_[list.b];
    const double thickness = list.thickness;
    const bool isBond = elements_.shareBond(a.surface, b.surface);

    // The margin is a share of the thickness, and more if the leaves move fast. Within one body it stays so small that
    // an element does not list its neighbours.
    const double cell = std::min(elements_.shortestEdge(a.surface), elements_.shortestEdge(b.surface));
    const double slow = isBond ? std::min(thickness, restShare * cell - thickness) : thickness;
    const double fast = std::min(blocksAhead * list.relativeMotion, std::max(2 * thickness, list.relativeMotion));
    const double margin = std::max({leastMargin * thickness, slow, fast});
    restart(list, margin);

    const ClosestKernels kernels = closestKernels();
    const double reach = nearShare * thickness + margin;
    const Query query{elements_, x0, kernels, thickness, margin, reach, isBond, list.a == list.b};
    const core::Aabb &boxA = bvh_.motion(list.a).before, &boxB = bvh_.motion(list.b).before;
    const LeafBoxes &ofA = boxes_[static_cast<std::size_t>(list.a)], &ofB = boxes_[static_cast<std::size_t>(list.b)];
    thread_local Scratch scratch;
    scratch.overlapping.clear();

    // Pairs of points and triangles first.
    BoxQuery boxes(kernels, reach);
    const auto addPoints = [&](const LeafBoxes& points, const core::Aabb& boxOfPoints, const LeafBoxes& triangles,
                               const core::Aabb& boxOfTriangles) {
        boxes.forEach(triangles.triangles, boxOfTriangles, points.points, boxOfPoints, [&](int t, int i) {
            const Triangle& triangle = query.triangle(t);
            const std::array<int, 3>& c = triangle.points;
            if (!elements_.areNeighbours(i, triangle))
                scratch.overlapping.push_back({i, t, {i, c[0], c[1], c[2]}, thickness});
        });
    };
    addPoints(ofA, boxA, ofB, boxB);
    if (!query.isOne) addPoints(ofB, boxB, ofA, boxA);
    appendInReach(
        query, kernels.onTriangles,
        [](const CandidatePair& p, const CandidatePair& q) { return p.b < q.b || (p.b == q.b && p.a < q.a); }, scratch,
        list);
    list.pointPairs = list.pairs.size();

    // Then pairs of edges.
    boxes.forEach(
        ofA.edges, boxA, ofB.edges, boxB,
        [&](int e, int f) {
            const int low = std::min(e, f), high = std::max(e, f);
            const Edge &first = query.edge(low), &second = query.edge(high);
            if (!elements_.areNeighbours(first, second))
                scratch.overlapping.push_back({low, high, {first.a, first.b, second.a, second.b}, thickness});
        });
    appendInReach(
        query, kernels.onSegments,
        [](const CandidatePair& p, const CandidatePair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); }, scratch,
        list);
    list.approachBudget = list.travelBudget;
}

}  // namespace taut::contact
