#include "taut/contact/broad_phase.h"

#include <algorithm>
#include <utility>

#include "taut/contact/closest_points.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr int boxedAtOnce = 16;      // leaves per task
constexpr double leewayShare = 0.5;  // of the thickness

// Appends what make(first, second, candidate) makes of the pairs and returns true for. Without a branch, which would be
// foretold wrongly: many elements whose boxes overlap are neighbours.
template <class Make>
void appendIf(std::span<const ElementPair> pairs, std::vector<CandidatePair>& candidates, const Make& make) {
    std::size_t count = candidates.size();
    candidates.resize(count + pairs.size());
    for (const ElementPair& pair : pairs) count += make(pair.first, pair.second, candidates[count]) ? 1 : 0;
    candidates.resize(count);
}

}  // namespace

BroadPhase::BroadPhase(const Elements& elements) : elements_(elements), bvh_(elements) {
    for (int s = 0; s < static_cast<int>(elements.surfaces().size()); ++s)
        if (const double own = elements.shortestEdge(s); own > 0 && !elements.isRigid(s))
            shortest_ = std::min(shortest_, own);
}

void BroadPhase::refresh() {
    bvh_.refresh();
    hasBoxes_.clear();
}

void BroadPhase::find(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    bvh_.fit(x0, x1);
    bvh_.findNear(near_);
    findBoxes(x0, x1);
}

void BroadPhase::findAstray(std::span<const dvec3> expected, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    near_.clear();
    astray_.assign(static_cast<std::size_t>(bvh_.count()), 0.0);
    for (std::size_t i = 0; i < x1.size(); ++i) {
        const double own = length(x1[i] - expected[i]);
        for (int leaf : bvh_.leavesAt(static_cast<int>(i))) {
            double& most = astray_[static_cast<std::size_t>(leaf)];
            most = std::max(most, own);
        }
    }
    const auto isAstray = [&](int leaf) {
        const double thickness = elements_.surface(bvh_[leaf].surface).thickness;
        return astray_[static_cast<std::size_t>(leaf)] > leewayShare * std::min(thickness, 0.5 * shortest_);
    };
    int first = 0;
    while (first < bvh_.count() && !isAstray(first)) ++first;
    if (first == bvh_.count()) return;
    bvh_.fit(x0, x1);
    bvh_.findNear(near_);
    std::erase_if(near_, [&](LeafPair pair) {
        const double own =
            astray_[static_cast<std::size_t>(lowOf(pair))] + astray_[static_cast<std::size_t>(highOf(pair))];
        return !(own > leeway(pair));
    });
    findBoxes(x0, x1);
}

double BroadPhase::motionBetween(LeafPair pair) const {
    const LeafMotion &a = bvh_.motion(lowOf(pair)), &b = bvh_.motion(highOf(pair));
    return length(a.way - b.way) + a.deviation + b.deviation;
}

// Elements of one body that are no neighbours may be as close at rest as its edges are long.
double BroadPhase::leeway(LeafPair pair) const {
    const int a = bvh_[lowOf(pair)].surface, b = bvh_[highOf(pair)].surface;
    return leewayShare * (elements_.shareBond(a, b) ? std::min(thickness(pair), shortest_) : thickness(pair));
}

// Of the leaves of near pairs -> boxes_.
void BroadPhase::findBoxes(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    boxes_.resize(static_cast<std::size_t>(bvh_.count()));
    hasBoxes_.resize(boxes_.size(), 0);
    for (int p = 0; p < bvh_.count(); ++p)
        if (bvh_.isRefitted(p)) hasBoxes_[static_cast<std::size_t>(p)] = 0;
    toBox_.clear();
    for (LeafPair pair : near_)
        for (int p : {lowOf(pair), highOf(pair)})
            if (std::exchange(hasBoxes_[static_cast<std::size_t>(p)], 1) == 0) toBox_.push_back(p);
    core::parallelFor(static_cast<int>(toBox_.size()), boxedAtOnce, [&](int k) {
        const int p = toBox_[static_cast<std::size_t>(k)];
        boxes_[static_cast<std::size_t>(p)].find(elements_, bvh_[p], x0, x1, bvh_.motion(p).way);
    });
}

void BroadPhase::addPoints(LeafPair pair, BoxQuery& query, std::vector<CandidatePair>& candidates) const {
    const int low = lowOf(pair), high = highOf(pair);
    const auto add = [&](int ofPoints, int ofTriangles) {
        const LeafBoxes &points = boxes_[static_cast<std::size_t>(ofPoints)],
                        &triangles = boxes_[static_cast<std::size_t>(ofTriangles)];
        const dvec3 way = bvh_.motion(ofPoints).way - bvh_.motion(ofTriangles).way;
        appendIf(query.find(nearShare * thickness(pair), points.points, points.whole, triangles.triangles,
                            triangles.whole, way),
                 candidates, [&](int point, int t, CandidatePair& candidate) {
                     const Triangle& triangle = elements_.triangles()[static_cast<std::size_t>(t)];
                     const std::array<int, 3>& c = triangle.points;
                     candidate = {point, t, {point, c[0], c[1], c[2]}};
                     return !elements_.areNeighbours(point, triangle);
                 });
    };
    add(high, low);
    if (low != high) add(low, high);
}

void BroadPhase::addEdges(LeafPair pair, BoxQuery& query, std::vector<CandidatePair>& candidates) const {
    const LeafBoxes &a = boxes_[static_cast<std::size_t>(lowOf(pair))],
                    &b = boxes_[static_cast<std::size_t>(highOf(pair))];
    const dvec3 way = bvh_.motion(lowOf(pair)).way - bvh_.motion(highOf(pair)).way;
    appendIf(query.find(nearShare * thickness(pair), a.edges, a.whole, b.edges, b.whole, way), candidates,
             [&](int e, int f, CandidatePair& candidate) {
                 const int low = std::min(e, f), high = std::max(e, f);
                 const Edge &first = elements_.edges()[static_cast<std::size_t>(low)],
                            &second = elements_.edges()[static_cast<std::size_t>(high)];
                 candidate = {low, high, {first.a, first.b, second.a, second.b}};
                 return !elements_.areNeighbours(first, second);
             });
}

}  // namespace taut::contact
