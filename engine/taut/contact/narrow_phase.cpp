// Narrow phase: measures the distance of each candidate pair, and decides which pairs become constraints.
//
// Each task has some pairs of leaves. It measures their candidates many at once (closest_kernel.h), and classifies the
// close ones. A pair is active if its gap is closed, or would close along its normal in this block. Its feature must
// also be the closest: in a sheet one point is close to several triangles and edges, and only the closest feature
// pushes.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "taut/contact/certificate.h"
#include "taut/contact/closest_points.h"
#include "taut/contact/contact_group.h"
#include "taut/contact/rigid_side.h"
#include "taut/contact/row_arithmetic.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr int leavesAtOnce = 8;       // pairs of leaves per task
constexpr double activeShare = 0.05;  // of the thickness: a gap below it is a contact
constexpr double leastTurn = 1e-3;    // of thickness and distance: what goes by less does not turn
constexpr double leastAlike = 0.5;    // cosine of the normals before and after
constexpr double mostOpenWay = 2.0;
constexpr double drivenSoftness = 0.01;  // of pairs with a driven surface: see solver.h

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

// A candidate pair as measured at x0.
struct ContactGroup::Measured {
    const CandidatePair& candidate;
    LeafPair leaves;
    bool isPoint;
    double thickness;     // [m] of the leaves' surfaces
    double leeway = 0;    // [m] see BroadPhase::leeway()
    double distance = 0;  // [m]
    std::array<double, 4> weights{};
    dvec3 separation{0.0};  // [m]
    std::int64_t where = 0;
};

// The constraint of a measured pair: points, weights, normal, distance. classify() decides whether it is active.
ContactConstraint ContactGroup::constraintOf(const Measured& measured, std::span<const dvec3> x0) {
    ContactConstraint pair;
    pair.isPoint = measured.isPoint;
    pair.leaves = measured.leaves;
    pair.a = measured.candidate.a;
    pair.b = measured.candidate.b;
    pair.points = measured.candidate.points;
    pair.thickness = measured.thickness;
    pair.distance = measured.distance;
    pair.weights = measured.weights;
    if (pair.hasSides()) {
        pair.normal = measured.separation / pair.distance;
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

// [m] The largest way of a point of one side from one of the other, at x1.
double ContactGroup::motionOf(const Measured& measured, const Ways& ways) {
    std::array<dvec3, 4> way;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(measured.candidate.points[k]);
        way[k] = ways.x1[i] - ways.x0[i];
    }
    double square = 0;
    const std::size_t firstSide = measured.isPoint ? 1 : 2;
    for (std::size_t a = 0; a < firstSide; ++a)
        for (std::size_t b = firstSide; b < 4; ++b)
            square = std::max(square, glm::dot(way[a] - way[b], way[a] - way[b]));
    return std::sqrt(square);
}

// Appends the pair if it is active, or close enough to need a certificate. Active pairs are closed or closing along the
// normal, on a feature of their own, and do not pass by. Cheap tests come first.
void ContactGroup::classify(Measured& measured, const Ways& ways, std::vector<ContactConstraint>& pairs) const {
    const auto& [x0, x1, mayPress] = ways;
    const CandidatePair& candidate = measured.candidate;
    const bool needsCertificate = measured.distance <= motionOf(measured, ways) + measured.leeway;
    const bool mayPush = mayPress && meetInside(candidate, measured.isPoint, measured.weights, measured.where);
    if (!mayPush && !needsCertificate) return;
    measured.thickness = elements_.thicknessOf(candidate.points, measured.isPoint);
    const double gap = measured.distance - measured.thickness;
    const bool isClosed = gap < activeShare * measured.thickness;
    dvec3 way(0.0);
    for (std::size_t k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(candidate.points[k]);
        way += measured.weights[k] * (x1[i] - x0[i]);
    }
    const auto closing = [&](const dvec3& normal) { return openWay() * -glm::dot(normal, way); };
    if (!needsCertificate && !isClosed && !(gap < closing(measured.separation / measured.distance))) return;
    ContactConstraint pair = constraintOf(measured, x0);
    const bool pushes = mayPush && (isClosed || gap < closing(pair.normal));
    if (pushes) pair.recovery = convexity(pair, measured.where, x0);
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

// By how many of its expected way a pair may close: in several steps springs and impulses change it.
double ContactGroup::openWay() const {
    return block_.steps > 1 ? mostOpenWay : 1.0;
}

// Measures the candidates of two leaves, many at once, and classifies the close ones.
void ContactGroup::measure(LeafPair leaves, std::span<const CandidatePair> candidates, bool isPoint, const Ways& ways,
                           const ClosestKernels& kernels, std::vector<ContactConstraint>& pairs) const {
    thread_local ClosestLanes lanes;
    const double thickness = broadPhase_.thickness(leaves), leeway = broadPhase_.leeway(leaves);
    // No pair of the leaves needs more than a look that is further apart.
    const double motion = broadPhase_.motionBetween(leaves);
    const double reach = std::max(leeway, thickness + activeShare * thickness) + motion;
    for (std::size_t first = 0; first < candidates.size(); first += closestBatch) {
        const std::span<const CandidatePair> some =
            candidates.subspan(first, std::min<std::size_t>(closestBatch, candidates.size() - first));
        for (std::size_t lane = 0; lane < some.size(); ++lane)
            for (std::size_t k = 0; k < 4; ++k) {
                const auto i = static_cast<std::size_t>(some[lane].points[k]);
                for (int axis = 0; axis < 3; ++axis) lanes.at[k][axis][lane] = ways.x0[i][axis];
            }
        (isPoint ? kernels.onTriangles : kernels.onSegments)(lanes, static_cast<int>(some.size()));
        for (std::size_t lane = 0; lane < some.size(); ++lane) {
            if (lanes.distance[lane] > reach) continue;
            Measured measured{.candidate = some[lane], .leaves = leaves, .isPoint = isPoint, .thickness = thickness};
            measured.leeway = leeway;
            measured.distance = lanes.distance[lane];
            measured.where = lanes.where[lane];
            for (std::size_t k = 0; k < 4; ++k) measured.weights[k] = lanes.weights[k][lane];
            for (int axis = 0; axis < 3; ++axis) measured.separation[axis] = lanes.separation[axis][lane];
            classify(measured, ways, pairs);
        }
    }
}

// The pairs of the near leaves -> tested_. Those that it has stay as they are.
void ContactGroup::runNarrowPhase(const Ways& ways) {
    const std::span<const LeafPair> near = broadPhase_.near();
    const int count = static_cast<int>(near.size()), tasks = (count + leavesAtOnce - 1) / leavesAtOnce;
    const ClosestKernels kernels = closestKernels();
    perTask_.resize(static_cast<std::size_t>(std::max(tasks, static_cast<int>(perTask_.size()))));
    const auto isBefore = [](const ContactConstraint& a, const ContactConstraint& b) { return a.comesBefore(b); };
    core::parallelFor(tasks, [&](int task) {
        std::vector<ContactConstraint>& own = perTask_[static_cast<std::size_t>(task)];
        own.clear();
        thread_local std::vector<CandidatePair> candidates;
        thread_local BoxQuery query;
        for (int k = task * leavesAtOnce; k < std::min((task + 1) * leavesAtOnce, count); ++k) {
            const LeafPair leaves = near[static_cast<std::size_t>(k)];
            candidates.clear();
            broadPhase_.addPoints(leaves, query, candidates);
            measure(leaves, candidates, true, ways, kernels, own);
            candidates.clear();
            broadPhase_.addEdges(leaves, query, candidates);
            measure(leaves, candidates, false, ways, kernels, own);
        }
        std::sort(own.begin(), own.end(), isBefore);
    });
    // Collect task by task, so that the order does not depend on threads.
    found_.clear();
    for (int task = 0; task < tasks; ++task) {
        const std::vector<ContactConstraint>& own = perTask_[static_cast<std::size_t>(task)];
        found_.insert(found_.end(), own.begin(), own.end());
    }
    if (tested_.empty()) return std::swap(tested_, found_);
    merged_.clear();
    std::set_union(tested_.begin(), tested_.end(), found_.begin(), found_.end(), std::back_inserter(merged_), isBefore);
    std::swap(tested_, merged_);
}

}  // namespace taut::contact
