// Narrow phase: measures the distance of each candidate pair that is due, and decides which pairs become constraints.
//
// Each task has some lists. It gathers their pairs that are due, measures them all at once (closest_kernel.h), and
// classifies each. A pair is active if its gap is closed, or would close along its normal in this block. Its feature
// must also be the closest: in a sheet one point is close to several triangles and edges, and only the closest feature
// of all pushes.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "taut/contact/certificate.h"
#include "taut/contact/closest_batch.h"
#include "taut/contact/closest_points.h"
#include "taut/contact/contact_group.h"
#include "taut/contact/rigid_side.h"
#include "taut/contact/row_arithmetic.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr int listsAtOnce = 16;
constexpr double activeShare = 0.05;  // of the thickness: a gap below it is a contact
constexpr double leastTurn = 1e-3;    // of thickness and distance: what goes by less does not turn
constexpr double leastAlike = 0.5;    // cosine of the normals before and after
constexpr double openWay = 2.0;       // times the way that is expected of several steps: springs and impulses change it
constexpr double drivenSoftness = 0.01;  // of pairs with a driven surface: see solver.h
constexpr double rounding = 1e-9;        // relative error of the list's sums of motion

// The list is due when the first of its pairs is due. The larger of a pair's two budgets counts.
void limitListTo(BroadPhase::CandidateList& list, double travelBudget, double approachBudget) {
    if (travelBudget - list.travelled > approachBudget - list.approached)
        list.leastTravelBudget = std::min(list.leastTravelBudget, travelBudget);
    else
        list.leastApproachBudget = std::min(list.leastApproachBudget, approachBudget);
}

}  // namespace

// Whether a constraint would keep crossed surfaces crossed: one side has a point on the wrong side of a contour, and
// the other side has a point at a contour too. Pairs of parts that did not cross stay constraints.
bool ContactGroup::isTangled(const ContactConstraint& pair) const {
    char first = unmarked, second = unmarked;
    for (int k = 0; k < 4; ++k) {
        char& side = k < pair.firstSide() ? first : second;
        side = std::max(side, marks_[static_cast<std::size_t>(pair.points[static_cast<std::size_t>(k)])]);
    }
    return std::min(first, second) != unmarked && std::max(first, second) == wrongSide;
}

// For a point whose closest place on the triangle is on an edge or at a corner: whether no triangle there is closer.
// Only the first of these triangles says yes, so that the point is pushed once.
bool ContactGroup::isFeatureNearest(const ContactConstraint& pair, int feature, std::span<const dvec3> x) const {
    const Triangle& triangle = elements_.triangles()[static_cast<std::size_t>(pair.b)];
    if (feature < 3) {
        const Edge& edge =
            elements_.edges()[static_cast<std::size_t>(triangle.edges[static_cast<std::size_t>(feature)])];
        if (edge.triangles[0] != pair.b) return false;
        if (edge.triangles[1] < 0) return true;
        const Triangle& other = elements_.triangles()[static_cast<std::size_t>(edge.triangles[1])];
        for (int i : other.points)
            if (i != edge.a && i != edge.b)
                return !(glm::dot(x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(edge.a)], pair.normal) >
                         0);
        return true;
    }
    const int corner = triangle.points[static_cast<std::size_t>(feature - 3)];
    if (elements_.firstTriangle(corner) != pair.b) return false;
    const dvec3& at = x[static_cast<std::size_t>(corner)];
    for (int other : elements_.neighbours(corner))
        if (glm::dot(x[static_cast<std::size_t>(other)] - at, pair.normal) > 0) return false;
    return true;
}

// A candidate pair, and its slot in the batch that measures it.
struct ContactGroup::Measured {
    BroadPhase::CandidateList* list;
    std::size_t pair;  // of the list
    int slot;
};

struct ContactGroup::NarrowPhaseScratch {
    ClosestBatch points, edges;
    std::vector<Measured> measured;  // list by list, pair by pair
    std::vector<int> due;
};

// Adds the due pairs of a list to the batches.
void ContactGroup::gather(BroadPhase::CandidateList& list, std::span<const dvec3> x0, const ClosestKernels& kernels,
                          NarrowPhaseScratch& scratch) const {
    // Find the pairs that have used up both budgets. The list gets the least budget of the others.
    scratch.due.resize(list.pairs.size());
    CandidateRows rows{static_cast<int>(list.pairs.size()),
                       list.travelBudget.data(),
                       list.approachBudget.data(),
                       list.travelled,
                       list.approached,
                       scratch.due.data()};
    const int dueCount = kernels.findDue(rows);
    list.leastTravelBudget = rows.leastTravelBudget;
    list.leastApproachBudget = rows.leastApproachBudget;
    // Pairs of points and triangles go to one batch, pairs of edges to the other.
    for (int n = 0; n < dueCount; ++n) {
        const auto k = static_cast<std::size_t>(scratch.due[static_cast<std::size_t>(n)]);
        ClosestBatch& batch = k < list.pointPairs ? scratch.points : scratch.edges;
        const int slot = batch.add(x0, list.pairs[k].points);
        scratch.measured.push_back({&list, k, slot});
    }
}

// The constraint of a measured pair: points, weights, normal, distance. classify() decides whether it is active.
ContactConstraint ContactGroup::constraintOf(const Measured& measured, const NarrowPhaseScratch& scratch,
                                             std::span<const dvec3> x0) const {
    const CandidatePair& candidate = measured.list->pairs[measured.pair];
    ContactConstraint pair;
    pair.isPoint = measured.pair < measured.list->pointPairs;
    const ClosestBatch& batch = pair.isPoint ? scratch.points : scratch.edges;
    pair.leaves = leafPair(measured.list->a, measured.list->b);
    pair.a = candidate.a;
    pair.b = candidate.b;
    pair.thickness = candidate.thickness;
    pair.distance = batch.distance(measured.slot);
    pair.weights = batch.weights(measured.slot);
    pair.points = candidate.points;
    if (pair.hasSides()) {
        pair.normal = batch.separation(measured.slot) / pair.distance;
    } else {
        // The two touch or cross, so the distance has no direction. Take the normal of the triangle, or of both edges;
        // of an edge and a ball, a normal of that edge.
        const auto at = [&](std::size_t k) -> const dvec3& { return x0[static_cast<std::size_t>(pair.points[k])]; };
        const dvec3 p = at(1) - at(pair.isPoint ? 3 : 0), q = at(pair.isPoint ? 2 : 3) - at(pair.isPoint ? 3 : 2);
        const dvec3 across = glm::cross(p, q);
        const double size = length(across);
        const dvec3 edge = p != dvec3(0.0) ? p : q;
        pair.normal = size > 0             ? across / size
                      : edge != dvec3(0.0) ? acrossOf(edge / length(edge))
                                           : dvec3(0.0, 1.0, 0.0);
    }
    return pair;
}

// Below 0 if another feature of the two surfaces is closer, so that this pair does not push here. Otherwise 1, or less
// for edges that are hardly convex. `where` is the kernel's.
double ContactGroup::convexity(const ContactConstraint& pair, std::int64_t where, std::span<const dvec3> x) const {
    if (pair.isPoint) {
        const int feature = static_cast<int>(where) - static_cast<int>(Feature::edge0);  // below 0: the face
        if (feature >= 0 && !isFeatureNearest(pair, feature, x)) return -1.0;
        const bool isCorner = elements_.isRigid(elements_.surfaceOf(pair.a));
        return isCorner && !isCornerNearest(elements_, pair.a, -pair.normal, x) ? -1.0 : 1.0;
    }
    const Edge &first = elements_.edges()[static_cast<std::size_t>(pair.a)],
               &second = elements_.edges()[static_cast<std::size_t>(pair.b)];
    // A ball beside a triangle is a point in a pair with that triangle.
    const bool isBall = first.a == first.b || second.a == second.b;
    if (isBall && (first.triangles[0] >= 0 || second.triangles[0] >= 0)) return -1.0;
    const auto at = [&](int i) -> const dvec3& { return x[static_cast<std::size_t>(i)]; };
    const dvec3 onFirst = pair.weights[0] * at(first.a) + pair.weights[1] * at(first.b);
    const dvec3 onSecond = -(pair.weights[2] * at(second.a) + pair.weights[3] * at(second.b));
    return std::min(convexityOf(elements_, first, onFirst, -pair.normal, x),
                    convexityOf(elements_, second, onSecond, pair.normal, x));
}

// Whether the closest places of two edges are inside both edges. Pairs of points and triangles handle the ends of a
// triangle's edges. The ends of lines push here too, because two ropes have no triangles.
bool ContactGroup::meetInside(const CandidatePair& pair, bool isPoint, const std::array<double, 4>& weights,
                              std::int64_t where) const {
    if (isPoint || where != 0) return true;
    const Edge &first = elements_.edges()[static_cast<std::size_t>(pair.a)],
               &second = elements_.edges()[static_cast<std::size_t>(pair.b)];
    const bool isRigidFirst = elements_.isRigid(first.surface), isRigidSecond = elements_.isRigid(second.surface);
    if (!isRigidFirst && !isRigidSecond) return first.isLine || second.isLine;
    // The ends of a rigid edge meet triangles as corners. The ends of a soft line meet the collider's faces elsewhere.
    const Edge& soft = isRigidFirst ? second : first;
    const double share = isRigidFirst ? -weights[3] : weights[1];
    return soft.isLine && share > 0 && share < 1;
}

// [m] Along the normal at x0 the gap closes as if both sides were flat. Where one turns past the other, as a point that
// goes under an edge, they are less near at x1 than that.
double ContactGroup::slackOf(const ContactConstraint& pair, const dvec3& way, std::span<const dvec3> x1) {
    const double along = glm::dot(pair.normal, way), across = glm::dot(way, way) - along * along;
    if (!(across > leastTurn * pair.thickness * pair.distance)) return 0;
    Corners then;
    for (std::size_t k = 0; k < 4; ++k) then[k] = x1[static_cast<std::size_t>(pair.points[k])];
    const dvec3 apart = closestPoints(then, pair.isPoint).separation;
    const double distance = length(apart);
    if (!(glm::dot(apart, pair.normal) > leastAlike * distance)) return 0;  // beyond, or about to be
    return std::max(0.0, distance - std::max(pair.distance + along, 0.0));
}

// Appends the pair if it is active, or close enough to need a certificate. mayPress: it may become active.
void ContactGroup::classify(const Measured& measured, std::span<const dvec3> x0, std::span<const dvec3> x1,
                            const NarrowPhaseScratch& scratch, bool mayPress,
                            std::vector<ContactConstraint>& pairs) const {
    BroadPhase::CandidateList& list = *measured.list;
    const CandidatePair& candidate = list.pairs[measured.pair];
    const bool isPoint = measured.pair < list.pointPairs;
    const ClosestBatch& batch = isPoint ? scratch.points : scratch.edges;
    const double distance = batch.distance(measured.slot), gap = distance - candidate.thickness;

    // The distance is the new budget: no matter how the two sides move, they are not in reach before the sum of their
    // motions is this large.
    double& travelBudget = list.travelBudget[measured.pair];
    travelBudget = std::max(travelBudget, distance + list.travelledBefore - nearShare * candidate.thickness);
    limitListTo(list, travelBudget, list.approachBudget[measured.pair]);
    // The leaves do not move enough in this block to close the gap.
    const double motion = (1 + rounding) * list.relativeMotion;
    if (gap > std::max(activeShare * candidate.thickness, motion)) return;

    // Active pairs are closed or closing along the normal, on a feature of their own, and do not pass by. Cheap tests
    // come first.
    const bool needsCertificate = distance <= motion + watchShare * candidate.thickness;
    const std::int64_t where = batch.where(measured.slot);
    const std::array<double, 4> weights = batch.weights(measured.slot);
    const bool mayPush = mayPress && meetInside(candidate, isPoint, weights, where);
    if (!mayPush && !needsCertificate) return;
    dvec3 way(0.0);
    for (std::size_t k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(candidate.points[k]);
        way += weights[k] * (x1[i] - x0[i]);
    }
    const bool isClosed = gap < activeShare * candidate.thickness;
    const auto closing = [&](const dvec3& normal) {
        return (block_.steps > 1 ? openWay : 1.0) * -glm::dot(normal, way);
    };
    if (!needsCertificate && !isClosed && !(gap < closing(batch.separation(measured.slot) / distance))) return;
    ContactConstraint pair = constraintOf(measured, scratch, x0);
    const bool pushes = mayPush && (isClosed || gap < closing(pair.normal));
    if (pushes) pair.recovery = convexity(pair, where, x0);
    pair.isActive = pushes && pair.recovery >= 0 && (isClosed || !misses(pair, x0, x1, 1.0 - activeShare));
    if (!pair.isActive && !needsCertificate) return;
    if (!crossings_.empty() && isTangled(pair)) return;
    const ContactSurface &a = elements_.surface(elements_.surfaceOf(pair.points[0])),
                         &b = elements_.surface(elements_.surfaceOf(pair.points[3]));
    pair.friction = (a.isOfCollider() || b.isOfCollider() ? 1.0 : options_.friction) * a.friction * b.friction;
    pair.restitution = options_.restitution * a.restitution * b.restitution;
    pair.turnFriction = a.turnFriction + b.turnFriction;
    if (a.isDriven || b.isDriven) pair.softness = drivenSoftness;
    if (pair.isActive && block_.steps > 1) pair.slack = slackOf(pair, way, x1);
    if (a.thickness + b.thickness > 0) pair.firstShare = a.thickness / (a.thickness + b.thickness);
    pairs.push_back(pair);
}

// The pairs of the lists that are due -> tested_. Those that it has stay as they are.
void ContactGroup::runNarrowPhase(std::span<const dvec3> x0, std::span<const dvec3> x1, bool mayPress) {
    const int count = static_cast<int>(broadPhase_.dueCount());
    const int tasks = (count + listsAtOnce - 1) / listsAtOnce;
    const ClosestKernels kernels = closestKernels();
    perTask_.resize(static_cast<std::size_t>(std::max(tasks, static_cast<int>(perTask_.size()))));
    core::parallelFor(tasks, [&](int task) {
        std::vector<ContactConstraint>& own = perTask_[static_cast<std::size_t>(task)];
        own.clear();
        thread_local NarrowPhaseScratch scratch;
        scratch.points.clear();
        scratch.edges.clear();
        scratch.measured.clear();
        // Gather, measure all together, classify in order.
        for (int k = task * listsAtOnce; k < std::min((task + 1) * listsAtOnce, count); ++k)
            gather(broadPhase_.due(static_cast<std::size_t>(k)), x0, kernels, scratch);
        scratch.points.solve(kernels.onTriangles);
        scratch.edges.solve(kernels.onSegments);
        for (const Measured& measured : scratch.measured) classify(measured, x0, x1, scratch, mayPress, own);
    });
    // Collect task by task, so that the order does not depend on threads.
    found_.clear();
    for (int task = 0; task < tasks; ++task) {
        const std::vector<ContactConstraint>& own = perTask_[static_cast<std::size_t>(task)];
        found_.insert(found_.end(), own.begin(), own.end());
    }
    const auto isBefore = [](const ContactConstraint& a, const ContactConstraint& b) { return a.comesBefore(b); };
    if (tested_.empty()) return std::swap(tested_, found_);
    merged_.clear();
    std::set_union(tested_.begin(), tested_.end(), found_.begin(), found_.end(), std::back_inserter(merged_), isBefore);
    std::swap(tested_, merged_);
}

}  // namespace taut::contact
