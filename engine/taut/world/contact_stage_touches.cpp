// Where whole bodies and convex solids meet colliders and each other.
#include "taut/world/private/contact_stage.h"

#include <algorithm>

#include "taut/contact/penetration.h"
#include "taut/contact/rigid_side.h"
#include "taut/core/across.h"
#include "taut/plan/held_pair.h"

namespace taut::world {
namespace {

constexpr int ofElement = 1 << 28, ofJoint = 1 << 29;  // in the name of a pair

}  // namespace

ContactStage::Penetration ContactStage::penetration(const std::function<bool(const Body&)>& wanted) {
    Penetration all;
    if (isEmpty()) return all;
    const auto isWanted = [&](int surface) { return isOfBody(surface) && wanted(bodyOf(surface)); };
    const std::vector<contact::Crossing>& now = crossings();  // places x1_
    for (const auto& [whole, thickness, points] : wholes_) {
        const Island& island = *bodyOf(whole).island;
        if (!isWanted(whole) || !bodyOf(whole).spec->collide || island.colliders().size() == 0) continue;
        if (elements().surface(whole).isConvex) continue;
        for (int i : points) all.ofPoints = std::max(all.ofPoints, -island.colliders().distance(position(i)));
    }
    findPresentTouches();
    for (const RigidTouch& touch : rigidTouches_)
        if (touch.other < 0 && isWanted(touch.surface)) all.ofPoints = std::max(all.ofPoints, -touch.gap);
    for (const ElementTouch& touch : elementTouches_)
        if (touch.collider >= 0 && isWanted(touch.surface))
            all.deepest = std::max(all.deepest, -touch.gap - touch.thickness);
    if (colliders_.isEmpty()) return all;
    all.deepest = std::max(all.deepest, contact::penetrationOf(elements(), now, x1_, isWanted));
    for (const contact::Crossing& crossing : now) {
        const auto sides = sidesOf(crossing);
        if (!sides || isOfBody(sides->second) || !isWanted(sides->first)) continue;
        ++all.figureCrossings;
        all.deepest = std::max(all.deepest, depthOf(crossing));
    }
    return all;
}

// Calls each(point, spec, thickness, surface) for the points of bodies that meet colliders as a whole which are now,
// came through one in the last `past` [s], from x0_, or might be `ahead` [s] later, in contact with a collider.
template <class Each>
void ContactStage::forEachNearCollider(double past, double ahead, const Each& each,
                                       const std::function<bool(int)>& isWanted) const {
    constexpr double nearShare = 0.05;  // of the thickness
    std::vector<collision::Colliders::Surface> found;
    for (const auto& [whole, thickness, points] : wholes_) {
        const Island& island = *bodyOf(whole).island;
        const BodySpec& spec = *bodyOf(whole).spec;
        if (!spec.collide || island.isStill() || (isWanted && !isWanted(whole))) continue;
        const double most = elements().surface(whole).thickness;
        found.clear();
        island.colliders().findNear({points, past > 0 ? x0_ : x1_, x1_, (1.0 + nearShare) * most, ahead, v_}, most,
                                    past, island.step(), found);
        for (const auto& near : found)
            if (!mountedOn_.contains({whole, near.collider}) &&
                !(elements().surface(whole).isConvex && convex_.isAllOf(near.collider)))
                each(near.point, spec, thickness, near);
    }
}

// The contacts of whole bodies with colliders in a block, `ahead` [s] long beyond its first step of h [s] ->
// kinematic_.
void ContactStage::addWholeContacts(double h, double ahead) {
    forEachNearCollider(
        h, ahead,
        [&](int i, const BodySpec& spec, double thickness, const collision::Colliders::Surface& surface) {
            const auto k = static_cast<std::size_t>(i);
            contact::KinematicContact& contact = kinematic_.emplace_back();
            contact.points[0] = i;
            contact.normal = surface.away;
            contact.carried = surface.velocity;
            contact.speed = glm::dot(surface.away, surface.velocity);
            contact.friction = surface.material.friction * spec.friction;
            contact.isWhole = true;
            contact.thickness = thickness;
            contact.restitution = surface.material.restitution * spec.restitution;
            contact.turnFriction = surface.material.turnFriction + spec.turnFriction;
            contact.spin = surface.spin;
            contact.arm = -thickness * surface.away;
            // At the start of the step, so that its way in this block is no overlap.
            contact.gap = surface.distance - thickness + glm::dot(surface.away, x0_[k] - x1_[k]) + h * contact.speed;
        });
}

// A collider around a held point of a solid is its axle.
bool ContactStage::isHeldIn(const Body& body, int collider) const {
    for (std::size_t i = 0; body.spec->isRigid() && i < body.model.held.size(); ++i)
        if (body.model.held[i] &&
            body.island->colliders().inside(body.island->position(body.pointOf[i])).collider == collider)
            return true;
    return false;
}

bool ContactStage::mayMeet(int surface, int collider) const {
    const Body& body = bodyOf(surface);
    return body.spec->facesMeetColliders() && !mountedOn_.contains({surface, collider}) && !isHeldIn(body, collider);
}

// Finds the touches of shapes from x0 to x1 (points) [m], in a part of the tick -> rigidTouches_, elementTouches_.
void ContactStage::findTouches(std::span<const dvec3> x0, std::span<const dvec3> x1, double from, double to,
                               bool alsoOfStill) {
    const auto meets = [&](int surface, int collider) {
        return (alsoOfStill || !bodyOf(surface).island->isStill()) && mayMeet(surface, collider);
    };
    const double seconds = to > from ? tickSeconds_ * (to - from) : tickSeconds_;
    shapes_.clear();
    convex_.addTo(shapes_, from, to);
    const auto mayTouch = [&](int surface, int other, int collider) {
        return other >= 0 ? elements().mayTouch(surface, other) : meets(surface, collider);
    };
    rigidTouches_ = rigid_.find(x0, x1, seconds, shapes_, mayTouch);
    elementTouches_ = ofElements_.find(elements(), x0, x1, seconds, rigid_.shapes(), mayTouch);
}

// Between two ticks, at x1_.
void ContactStage::findPresentTouches() {
    findTouches(x1_, x1_, 1.0, 1.0, true);
}

std::vector<RigidTouch> ContactStage::overlaps() {
    std::vector<RigidTouch> all;
    if (isEmpty()) return all;
    crossings();  // places x1_
    findPresentTouches();
    for (const RigidTouch& touch : rigidTouches_)
        if (touch.other >= 0 && touch.gap < -touch.thickness) all.push_back(touch);
    return all;
}

// -> kinematic_, rigidPairs_.
void ContactStage::addTouches() {
    rigidPairs_.clear();
    const auto pointOf = [&](int surface) { return elements().surface(surface).points.front(); };
    // Of a collider, with a body that has this point.
    const auto add = [&](int collider, int point, const dvec3& normal, const dvec3& place, const dvec3& velocity,
                         const dvec3& spin, double gap) -> contact::KinematicContact& {
        const int surface = elements().surfaceOf(point);
        const BodySpec& spec = *bodyOf(surface).spec;
        const collision::Material& material = materials_[static_cast<std::size_t>(collider)];
        contact::KinematicContact& contact = kinematic_.emplace_back();
        contact.points[0] = point;
        contact.normal = normal;
        contact.carried = velocity;
        contact.speed = glm::dot(normal, velocity);
        contact.friction = material.friction * spec.friction;
        contact.isWhole = true;
        contact.gap = gap;
        contact.thickness = elements().surface(surface).thickness;
        contact.arm = place - xStart_[static_cast<std::size_t>(point)];
        contact.restitution = material.restitution * spec.restitution;
        contact.turnFriction = material.turnFriction + spec.turnFriction;
        contact.spin = spin;
        return contact;
    };
    // Of a solid, the first side, and another body.
    const auto addPair = [&](int solid, int other, double gap, double thickness) -> contact::ContactConstraint& {
        const BodySpec &first = *bodyOf(solid).spec, &second = *bodyOf(other).spec;
        contact::ContactConstraint& pair = rigidPairs_.emplace_back();
        pair.distance = gap + thickness;
        pair.thickness = thickness;
        pair.friction = spec_.friction * first.friction * second.friction;
        pair.restitution = spec_.restitution * first.restitution * second.restitution;
        pair.turnFriction = first.turnFriction + second.turnFriction;
        pair.isPoint = pair.isActive = true;
        return pair;
    };
    constexpr double pivotReach = 4.0;  // of the thickness
    for (const RigidTouch& touch : rigidTouches_) {
        if (isAtPivot(touch.surface, touch.other, touch.collider, touch.onFirst, pivotReach * touch.thickness))
            continue;
        const int a = pointOf(touch.surface);
        if (touch.other < 0) {
            add(touch.collider, a, touch.normal, touch.onFirst, touch.velocity, touch.spin, touch.gap);
            continue;
        }
        const int b = pointOf(touch.other);
        contact::ContactConstraint& pair = addPair(touch.surface, touch.other, touch.gap, touch.thickness);
        pair.points = {a, b, b, b};
        pair.weights = {1.0, 0.0, 0.0, -1.0};
        pair.normal = touch.normal;
        pair.a = touch.first;
        pair.b = collision::Manifold::most * touch.second + touch.number;
        pair.places = {{touch.onFirst, touch.onSecond}};
    }
    for (const ElementTouch& touch : elementTouches_) {
        const contact::ContactSurface& surface = elements().surface(touch.surface);
        if (isAtPivot(touch.surface, touch.solid, touch.collider, touch.place, pivotReach * touch.thickness)) continue;
        if (touch.solid >= 0) {
            // Both are pressed where the element is.
            contact::ContactConstraint& pair = addPair(touch.solid, touch.surface, touch.gap, touch.thickness);
            pair.points[0] = pointOf(touch.solid);
            pair.weights[0] = 1.0;
            for (std::size_t k = 0; k < 3; ++k) {
                pair.points[k + 1] = touch.points[k] < 0 ? touch.points[0] : touch.points[k];
                pair.weights[k + 1] = -touch.weights[k];
            }
            pair.normal = -touch.normal;
            pair.a = ofElement | touch.shape;
            pair.b = touch.element;
            pair.places = {{touch.place, touch.place}};
            continue;
        }
        contact::KinematicContact& contact =
            add(touch.collider, touch.points[0], touch.normal, touch.place - surface.thickness * touch.normal,
                touch.velocity, touch.spin, touch.gap);
        contact.points = touch.points;
        contact.weights = touch.weights;
        if (!contact::mayYield(contact.used(), std::span(contact.weights).first(contact.used().size()), inverseMass_))
            kinematic_.pop_back();
    }
}

// Where the pins of joints are whose sides touch -> pivots_.
void ContactStage::placePivots(double t) {
    for (Pivot& pivot : pivots_) {
        const IslandPlan& plan = pivot.part->island->plan();
        const auto x = std::span<const dvec3>(xStart_).subspan(static_cast<std::size_t>(pivot.part->first));
        pivot.pins = 0;
        for (const HeldPair& pair : pivot.part->island->heldPairs(t))
            if (pair.length == 0 && !pair.line && pivot.pins < 2 && plan.ties[pivot.tie].has(pair.by))
                pivot.at[static_cast<std::size_t>(pivot.pins++)] = pair.a.at(plan, x, t);
    }
}

// Whether a joint holds two sides together within this reach [m] of a place. A contact so near to the axle has no lever
// to turn the sides, and an overlap δ by rounding would open a lid by δ over the distance. There the joint alone keeps
// the sides in place.
bool ContactStage::isAtPivot(int surface, int other, int collider, const dvec3& place, double reach) const {
    const auto solidAt = [&](int own) {
        return own < 0 ? -1 : solidOf_[static_cast<std::size_t>(elements().surface(own).points.front())];
    };
    return std::any_of(pivots_.begin(), pivots_.end(), [&](const Pivot& pivot) {
        if (pivot.pins == 0 || pivot.collider != collider) return false;
        const int a = solidAt(surface), b = solidAt(other);
        if (!(a == pivot.solid && b == pivot.other) && !(b == pivot.solid && a == pivot.other)) return false;
        dvec3 way = place - pivot.at[0];
        if (pivot.pins == 2) {
            const dvec3 axle = pivot.at[1] - pivot.at[0];
            way -= glm::dot(way, axle) / glm::dot(axle, axle) * axle;
        }
        return glm::dot(way, way) < reach * reach;
    });
}

// Rows of the joints of solids at t [s], where their block begins -> rigidPairs_.
void ContactStage::addJoints(double t) {
    int name = ofJoint;
    for (const Part& part : parts_) {
        if (part.island->plan().solids.empty() || part.island->isStill()) continue;
        for (const HeldPair& pair : part.island->heldPairs(t))
            if (addJoint(part, pair, t, name)) ++name;
    }
}

// A row for the pair along its length, along each axis if its ends are in one place, or across its line. Returns
// whether one of them is of a solid and both move with few enough points for a row.
bool ContactStage::addJoint(const Part& part, const HeldPair& pair, double t, int name) {
    using Kind = contact::ContactConstraint::Kind;
    const auto isSolid = [&](const HeldPair::End& end) {
        return end.place == nullptr && solidOf_[static_cast<std::size_t>(part.first + end.point())] >= 0;
    };
    const bool isTurned = !isSolid(pair.a);
    const HeldPair::End &first = isTurned ? pair.b : pair.a, &second = isTurned ? pair.a : pair.b;
    const bool areFew = second.place != nullptr || isSolid(second) || second.spot.shares().size() <= 3;
    if (!isSolid(first) || !areFew) return false;
    contact::ContactConstraint row{};
    row.points.fill(part.first + first.point());
    row.weights = {1.0, 0.0, 0.0, 0.0};
    const auto take = [&](std::size_t k, int point, double weight) {
        row.points[k] = part.first + point;
        row.weights[k] = -weight;
    };
    if (isSolid(second))
        take(1, second.point(), 1.0);
    else if (second.place == nullptr)
        for (std::size_t k = 0; k < second.spot.shares().size(); ++k)
            take(k + 1, second.spot.shares()[k].point, second.spot.shares()[k].weight);
    const IslandPlan& plan = part.island->plan();
    const auto x = std::span<const dvec3>(xStart_).subspan(static_cast<std::size_t>(part.first));
    auto [here, there] = pair.ends(plan, x, t);
    if (isTurned) std::swap(here, there);
    const dvec3 between = there - here;
    const double length = std::sqrt(glm::dot(between, between));
    row.isPoint = row.isActive = true;
    row.places = {{here, there}};
    row.a = name;
    row.kind = pair.isMost ? Kind::leash : Kind::joint;
    row.distance = pair.length - length;
    std::array<dvec3, 3> normals{dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.0, 1.0)};
    int count = 3;
    if (pair.length > 0) {
        count = 1;
        if (length > 0) normals[0] = between / length;
    } else if (pair.line) {
        count = 2;
        const dvec3 along = pair.along(plan, x, t);
        normals[0] = core::acrossOf(along);
        normals[1] = glm::cross(along, normals[0]);
    }
    for (row.b = 0; row.b < count; ++row.b) {
        row.normal = normals[static_cast<std::size_t>(row.b)];
        rigidPairs_.push_back(row);
    }
    return true;
}

}  // namespace taut::world
