// Where near pairs are in an instant, and which of them press.
#include <algorithm>
#include <cmath>

#include "taut/contact/certificate.h"
#include "taut/contact/closest_batch.h"
#include "taut/contact/closest_points.h"
#include "taut/contact/contact_group.h"
#include "taut/contact/rigid_side.h"
#include "taut/core/parallel.h"

namespace taut::contact {
namespace {

constexpr int listsAtOnce = 16;
constexpr double activeShare = 0.05;  // of the distance kept: a gap below it is a contact
constexpr double nothing = 1e-9;      // [m] no direction can be told of less
constexpr double rounding = 1e-9;     // of sums that two ways reach

// It may come near only once its list has gone so far.
void sleep(BroadPhase::CandidateList& list, double nearTravelled, double nearApproached) {
    if (nearTravelled - list.travelled > nearApproached - list.approached)
        list.asleepTravelled = std::min(list.asleepTravelled, nearTravelled);
    else
        list.asleepApproached = std::min(list.asleepApproached, nearApproached);
}

}  // namespace

// Pairs of crossed surfaces would be held where they are; but those of what is not through keep it so.
bool ContactGroup::isTangled(const ContactConstraint& pair) const {
    char first = unmarked, second = unmarked;
    for (int k = 0; k < 4; ++k) {
        char& side = k < pair.firstSide() ? first : second;
        side = std::max(side, marks_[static_cast<std::size_t>(pair.points[static_cast<std::size_t>(k)])]);
    }
    return std::min(first, second) != unmarked && std::max(first, second) == wrongSide;
}

// How far the faces beside an edge stay behind what lies outward of a place on it: 1 of a ridge, 0 where one rises beside
// it by `valley`, and less where it is nearer than the edge.
double ContactGroup::ridge(const Edge& edge, const dvec3& on, const dvec3& outward, std::span<const dvec3> x) const {
    double most = 0;  // sine of the steepest
    for (int t : edge.triangles) {
        if (t < 0) continue;
        for (int i : elements_.triangles()[static_cast<std::size_t>(t)].points) {
            if (i == edge.a || i == edge.b) continue;
            const dvec3 inwards = x[static_cast<std::size_t>(i)] - on;
            const double rise = glm::dot(inwards, outward);
            if (rise > most * length(inwards)) most = rise / length(inwards);
        }
    }
    return areWingsBehind(edge, outward, x) ? std::min(1.0, 2.0 * (1.0 - most / valley)) : -1.0;
}

// Of a point whose nearest place on a triangle is on an edge or a corner: whether that is so of all triangles there,
// and this is the first of them, so that the point is pressed away from it once.
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

// A pair of which the distance is found.
struct ContactGroup::Measured {
    BroadPhase::CandidateList* list;
    std::size_t pair;  // of the list
    int slot;
};

// Of lists: first what has to be measured, then all of that together, then what comes of it, pair by pair in order.
struct ContactGroup::NarrowPhaseScratch {
    ClosestBatch points, edges;
    std::vector<Measured> measured;
    std::vector<int> awake;
};

void ContactGroup::gather(BroadPhase::CandidateList& list, std::span<const dvec3> x0, const ClosestKernels& kernels,
                          NarrowPhaseScratch& scratch) const {
    const auto at = [&](int i) -> const dvec3& { return x0[static_cast<std::size_t>(i)]; };
    scratch.awake.resize(list.pairs.size());
    CandidateRows rows{static_cast<int>(list.pairs.size()),
                       list.nearTravelled.data(),
                       list.nearApproached.data(),
                       list.travelled,
                       list.approached,
                       scratch.awake.data()};
    const int awake = kernels.findAwake(rows);
    list.asleepTravelled = rows.asleepTravelled;
    list.asleepApproached = rows.asleepApproached;
    for (int n = 0; n < awake; ++n) {
        const auto k = static_cast<std::size_t>(scratch.awake[static_cast<std::size_t>(n)]);
        const CandidatePair& near = list.pairs[k];
        int slot;
        if (k < list.pointPairs) {
            const std::array<int, 3>& c = elements_.triangles()[static_cast<std::size_t>(near.b)].points;
            slot = scratch.points.add(at(near.a), at(c[0]), at(c[1]), at(c[2]));
        } else {
            const Edge &first = elements_.edges()[static_cast<std::size_t>(near.a)],
                       &second = elements_.edges()[static_cast<std::size_t>(near.b)];
            slot = scratch.edges.add(at(first.a), at(first.b), at(second.a), at(second.b));
        }
        scratch.measured.push_back({&list, k, slot});
    }
}

void ContactGroup::classify(const Measured& measured, std::span<const dvec3> x0, std::span<const dvec3> x1,
                            const NarrowPhaseScratch& scratch, std::vector<ContactConstraint>& pairs) const {
    BroadPhase::CandidateList& list = *measured.list;
    const CandidatePair& near = list.pairs[measured.pair];
    const bool isPoint = measured.pair < list.pointPairs;
    const ClosestBatch& batch = isPoint ? scratch.points : scratch.edges;
    const double apart = batch.distance(measured.slot), gap = apart - near.thickness;
    double& nearTravelled = list.nearTravelled[measured.pair];
    nearTravelled = std::max(nearTravelled, apart + list.way - nearShare * near.thickness);
    sleep(list, nearTravelled, list.nearApproached[measured.pair]);
    // No pair comes nearer than its list.
    if (list.isFlat || gap > std::max(activeShare * near.thickness, (1 + rounding) * list.coming)) return;

    const auto at = [&](int i) -> const dvec3& { return x0[static_cast<std::size_t>(i)]; };
    ContactConstraint pair;
    pair.a = near.a;
    pair.b = near.b;
    pair.isPoint = isPoint;
    pair.thickness = near.thickness;
    pair.distance = apart;
    pair.weights = batch.weights(measured.slot);
    const auto where = batch.where(measured.slot);
    int feature = -1;
    bool areInside = true;
    int surfaceA = 0, surfaceB = 0;
    if (isPoint) {
        const Triangle& triangle = elements_.triangles()[static_cast<std::size_t>(near.b)];
        const std::array<int, 3>& c = triangle.points;
        pair.points = {near.a, c[0], c[1], c[2]};
        feature = static_cast<int>(where) - static_cast<int>(Feature::edge0);
        surfaceA = elements_.surfaceOf(near.a);
        surfaceB = triangle.surface;
    } else {
        const Edge &first = elements_.edges()[static_cast<std::size_t>(near.a)],
                   &second = elements_.edges()[static_cast<std::size_t>(near.b)];
        pair.points = {first.a, first.b, second.a, second.b};
        surfaceA = first.surface;
        surfaceB = second.surface;
        areInside = where != 0 || first.isLine || second.isLine;
        // Ends of a rigid edge meet triangles as corners; ends of others meet its faces elsewhere.
        const bool isRigidFirst = elements_.isRigid(surfaceA), isRigidSecond = elements_.isRigid(surfaceB);
        if (isRigidFirst || isRigidSecond) {
            const Edge& soft = isRigidFirst ? second : first;
            const double share = isRigidFirst ? -pair.weights[3] : pair.weights[1];
            areInside = where != 0 || (soft.isLine && share > 0 && share < 1);
        }
    }
    if (apart > nothing) {
        pair.normal = batch.apart(measured.slot) / apart;
    } else {
        // Through each other, or nearly: which side is which cannot be told.
        const dvec3 p = at(pair.points[1]) - at(pair.points[pair.isPoint ? 3 : 0]);
        const dvec3 q = at(pair.points[pair.isPoint ? 2 : 3]) - at(pair.points[pair.isPoint ? 3 : 2]);
        const dvec3 across = glm::cross(p, q);
        const double size = length(across);
        pair.normal = size > 0 ? across / size : dvec3(0.0, 1.0, 0.0);
    }
    dvec3 way(0.0);
    for (std::size_t i = 0; i < 4; ++i)
        way += pair.weights[i] * (x1[static_cast<std::size_t>(pair.points[i])] - at(pair.points[i]));
    pair.isActive = areInside && (gap < activeShare * pair.thickness || gap + glm::dot(pair.normal, way) < 0);
    if (pair.isActive && pair.isPoint && feature >= 0) pair.isActive = isFeatureNearest(pair, feature, x0);
    if (pair.isActive && pair.isPoint && elements_.isRigid(surfaceA))
        pair.isActive = isCornerNearest(elements_, near.a, -pair.normal, x0);
    if (pair.isActive && !pair.isPoint) {
        const Edge &first = elements_.edges()[static_cast<std::size_t>(near.a)],
                   &second = elements_.edges()[static_cast<std::size_t>(near.b)];
        const dvec3 onFirst = pair.weights[0] * at(first.a) + pair.weights[1] * at(first.b);
        const dvec3 onSecond = -(pair.weights[2] * at(second.a) + pair.weights[3] * at(second.b));
        // A ball beside a triangle is a point of a pair with it.
        const bool isBall = first.a == first.b || second.a == second.b;
        if (isBall && (first.triangles[0] >= 0 || second.triangles[0] >= 0))
            pair.isActive = false;
        else
            pair.recovery = std::min(ridge(first, onFirst, -pair.normal, x0), ridge(second, onSecond, pair.normal, x0));
        if (pair.recovery < 0) pair.isActive = false;
    }
    if (pair.isActive && gap >= activeShare * pair.thickness && misses(pair, x0, x1, 1.0 - activeShare))
        pair.isActive = false;
    if (!pair.isActive && apart > list.coming + watchShare * pair.thickness) return;
    if (!crossings_.empty() && isTangled(pair)) return;
    const Surface &a = elements_.surface(surfaceA), &b = elements_.surface(surfaceB);
    pair.friction = (a.isRigid || b.isRigid ? 1.0 : options_.friction) * a.friction * b.friction;
    pairs.push_back(pair);
}

void ContactGroup::runNarrowPhase(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    const int count = static_cast<int>(broadPhase_.awakeCount());
    const int tasks = (count + listsAtOnce - 1) / listsAtOnce;
    const ClosestKernels kernels = closestKernels();
    found_.resize(static_cast<std::size_t>(std::max(tasks, static_cast<int>(found_.size()))));
    core::parallelFor(tasks, [&](int task) {
        std::vector<ContactConstraint>& own = found_[static_cast<std::size_t>(task)];
        own.clear();
        thread_local NarrowPhaseScratch scratch;
        scratch.points.clear();
        scratch.edges.clear();
        scratch.measured.clear();
        for (int k = task * listsAtOnce; k < std::min((task + 1) * listsAtOnce, count); ++k)
            gather(broadPhase_.awake(static_cast<std::size_t>(k)), x0, kernels, scratch);
        scratch.points.solve(kernels.onTriangles);
        scratch.edges.solve(kernels.onSegments);
        for (const Measured& measured : scratch.measured) classify(measured, x0, x1, scratch, own);
    });
    contacts_.clear();
    for (int task = 0; task < tasks; ++task) {
        const std::vector<ContactConstraint>& own = found_[static_cast<std::size_t>(task)];
        contacts_.insert(contacts_.end(), own.begin(), own.end());
    }
}

}  // namespace taut::contact
