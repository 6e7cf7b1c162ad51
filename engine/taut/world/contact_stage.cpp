#include "taut/world/private/contact_stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "taut/bodies/private/carried_surface.h"
#include "taut/contact/penetration.h"
#include "taut/contact/rigid_side.h"
#include "taut/core/private/parallel.h"
#include "taut/core/rigid_motion.h"
#include "taut/plan/constraint.h"
#include "taut/plan/private/pins.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

constexpr double longestStep = 1.1e-3;  // [s] of contact with deformable bodies
constexpr int stepsOfBlock = 2;         // of the longest ones, in a block of the usual length
constexpr int mostStepsForSpeed = 64;   // in a tick
constexpr int mostGrowth = 2;           // of a block after a calm one, times the usual length
// Of two sides from one another or past, times their thickness:
constexpr double mostWay = 3.0;  // in a block, and in a step
constexpr double calmWay = 1.0;  // in a block of which the next one is longer, and in any block where something bounces
// Of an element past a solid in a block: the solid stands on the rows of such elements.
constexpr double mostWayOnSolid = 0.2;
constexpr int ofElement = 1 << 28;     // in the name of a pair
constexpr double stickingShare = 0.9;  // of Coulomb's limit: up to there friction may hold what sleeps

using Clock = std::chrono::steady_clock;  // for reports only

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// The number of the solid that a body is of, where those of its plan begin at `first`; -1: of none.
int solidOf(const IslandPlan& plan, const Body& body, int first) {
    for (std::size_t k = 0; k < plan.solids.size(); ++k)
        if (std::count(plan.solids[k].begin(), plan.solids[k].end(), &body) > 0) return first + static_cast<int>(k);
    return -1;
}

// Puts next to each other what is near each other.
void sortInSpace(std::span<int> points, std::span<const dvec3> places) {
    constexpr std::size_t few = 16;
    if (points.size() <= few) return;
    core::Aabb box;
    for (const int i : points) box.add(places[static_cast<std::size_t>(i)]);
    const dvec3 size = box.halfSize();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = points.size() / 2;
    std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half), points.end(),
                     [&](int a, int b) {
                         return places[static_cast<std::size_t>(a)][axis] < places[static_cast<std::size_t>(b)][axis];
                     });
    sortInSpace(points.first(half), places);
    sortInSpace(points.subspan(half), places);
}

}  // namespace

int fewestSteps(double tickSeconds) {
    int steps = 1;
    while (tickSeconds / steps > longestStep) steps *= 2;
    return steps;
}

bool touches(const IslandPlan& plan) {
    return std::any_of(
        plan.bodies.begin(), plan.bodies.end(), [](const Body* body) { return body->spec->facesMeet(); });
}

contact::ContactSurface surfaceOf(const Body& body, const mechanics::RigidPart& part, int offset, int bond) {
    const mechanics::Model& model = body.model;
    const auto isOfPart = [&](int i) { return i >= part.first && i < part.last; };
    contact::ContactSurface surface;
    surface.thickness = part.thickness;
    surface.friction = body.spec->friction;
    surface.restitution = body.spec->restitution;
    surface.turnFriction = body.spec->turnFriction;
    surface.meetsItself = body.spec->touch == Touch::all;
    surface.meetsOthers = body.spec->touch != Touch::nothing;
    surface.meetsRigid = body.spec->facesMeetColliders();
    surface.bond = bond;
    const auto at = [&](int i) { return offset + body.pointOf[static_cast<std::size_t>(i)]; };
    std::vector<std::array<int, 3>> triangles = model.triangles;
    std::erase_if(triangles, [&](const auto& t) { return !isOfPart(t[0]); });
    for (const std::array<int, 3>& t : triangles) surface.triangles.push_back({at(t[0]), at(t[1]), at(t[2])});
    std::vector<bool> isOutside(model.positions.size(), triangles.empty());
    for (const std::array<int, 3>& t : triangles)
        for (int i : t) isOutside[static_cast<std::size_t>(i)] = true;
    if (triangles.empty())
        for (const mechanics::Spring& s : model.springs)
            if (isOfPart(s.a) && s.kind == mechanics::SpringKind::structural)
                surface.lines.push_back({at(s.a), at(s.b)});
    for (int i = part.first; i < part.last; ++i)
        if (isOutside[static_cast<std::size_t>(i)]) surface.points.push_back(at(i));
    surface.thickness += part.sag;
    return surface;
}

void carry(const CarriedSurface& own, const std::function<int(int)>& numberOf, contact::ContactSurface& surface,
           std::vector<dvec3>& rest, std::vector<contact::CarriedPoint>& carried) {
    if (own.points.empty()) return;
    const int first = static_cast<int>(rest.size());
    rest.insert(rest.end(), own.rest.begin(), own.rest.end());
    for (const mechanics::CarriedPoint& point : own.points) {
        carried.push_back({point.points, point.weights});
        for (int& i : carried.back().by) i = numberOf(i);
    }
    surface.points.resize(own.points.size());
    std::iota(surface.points.begin(), surface.points.end(), first);
    surface.triangles.clear();
    for (const std::array<int, 3>& t : own.triangles)
        surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

ContactStage::ContactStage(std::span<const std::unique_ptr<Island>> islands, const ContactSpec& spec,
                           const TickTime& now, StepFollowing& pace,
                           const std::function<std::vector<TouchedCollider>()>& colliders)
    : spec_(spec), tickSeconds_(1.0 / now.ticksPerSecond), fewest_(fewestSteps(tickSeconds_)), pace_(pace) {
    std::vector<contact::ContactSurface> surfaces;
    std::vector<dvec3> rest;
    std::vector<int> offsets;  // (bodies) of their island's points
    for (const auto& island : islands) {
        if (!touches(island->plan())) continue;
        const int offset = static_cast<int>(rest.size());
        const std::vector<dvec3>& start = island->plan().positions;
        rest.insert(rest.end(), start.begin(), start.end());
        for (const Body* body : island->plan().bodies) {
            if (!body->spec->facesMeet()) continue;
            for (const mechanics::RigidPart& part : surfacesOf(*body)) {
                surfaces.push_back(surfaceOf(*body, part, offset, static_cast<int>(islands_.size())));
                surfaces.back().solid = solidOf(island->plan(), *body, static_cast<int>(solids_.size()));
                if (!body->pieces.empty()) addPiece(*body, surfaces.back(), offset);
                if (body->spec->meetsCollidersAsWhole() || body->damage.goneTetrahedra() > 0)
                    wholes_.push_back({static_cast<int>(bodies_.size()), part.thickness, {}});
                offsets.push_back(offset);
                bodies_.push_back(body);
            }
            for (std::size_t i = 0; i < body->pointOf.size(); ++i) {
                const int point = offset + body->pointOf[i];
                rest[static_cast<std::size_t>(point)] = body->model.positions[i] - jitterOf(*body, static_cast<int>(i));
            }
        }
        for (const auto& bodies : island->plan().solids) {
            std::vector<int>& solid = solids_.emplace_back();
            for (const Body* body : bodies)
                for (int i : body->pointOf) solid.push_back(offset + i);
            std::sort(solid.begin(), solid.end());
        }
        islands_.push_back(island.get());
        parts_.push_back({island.get(), offset, static_cast<int>(rest.size())});
    }
    if (islands_.empty()) return;
    const int firstCarried = static_cast<int>(rest.size());
    std::vector<contact::CarriedPoint> carriedPoints;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const auto numberOf = [&](int i) { return offsets[k] + bodies_[k]->pointOf[static_cast<std::size_t>(i)]; };
        carry(carriedSurface(*bodies_[k]), numberOf, surfaces[k], rest, carriedPoints);
    }
    std::vector<TouchedCollider> touched;
    if (std::any_of(bodies_.begin(), bodies_.end(), [](const Body* body) { return body->spec->facesMeetColliders(); }))
        touched = colliders();
    for (std::size_t c = 0; c < touched.size(); ++c) {
        materials_.push_back(touched[c].material);
        colliderNames_.push_back(touched[c].name);
        convex_.add(static_cast<int>(c), touched[c].convex, touched[c].pose);
    }
    const bool areAny = !convex_.isEmpty() || !rigid_.isEmpty();
    for (contact::ContactSurface& surface : surfaces)
        surface.meetsShapes = areAny && !surface.isConvex && (surface.meetsRigid || surface.meetsOthers);
    colliders_ = ColliderSurfaces(touched, now.start(), surfaces, rest);
    for (auto* list : {&x0_, &x1_, &v_}) list->resize(rest.size());
    inverseMass_.resize(rest.size());
    damage_.assign(bodies_.size(), 0);
    contact::ContactOptions options;
    options.friction = spec.friction;
    options.restitution = spec.restitution;
    group_ = std::make_unique<contact::ContactGroup>(std::move(surfaces), std::move(rest), options);
    group_->setCarried({firstCarried, std::move(carriedPoints)});
    for (Whole& whole : wholes_) {
        whole.points = elements().surface(whole.surface).points;
        sortInSpace(whole.points, elements().rest());
    }
    for (const Part& part : parts_)
        for (const JointTie& tie : part.island->plan().ties)
            if (tie.isSeam) group_->elements().sew(part.first + tie.a, part.first + tie.b);
    keepJoinedApart(offsets, touched);
    colliders_.placeAll(x1_);
    x0_ = x1_;
}

// The convex shape of the part of a solid that is the last surface.
void ContactStage::addPiece(const Body& body, contact::ContactSurface& surface, int offset) {
    const int number = static_cast<int>(bodies_.size());
    std::size_t part = 0;
    for (auto before = bodies_.rbegin(); before != bodies_.rend() && *before == &body; ++before) ++part;
    const collision::PlacedConvex& piece = body.pieces[part];
    surface.isConvex = piece.shape != nullptr;
    if (!surface.isConvex) return;
    surface.isFormula = piece.shape->closed().kind != collision::ClosedKind::none;
    RigidMarks marks = marksOf(body);
    for (int& i : marks.points) i = offset + body.pointOf[static_cast<std::size_t>(i)];
    rigid_.addSolid({number, piece, marks, body.model.parts[part].thickness});
}

// Faces of rigid bodies would keep apart the points that joints hold together, and colliders those that they carry.
// offsets: (surfaces) of their island's points.
void ContactStage::keepJoinedApart(std::span<const int> offsets, std::span<const TouchedCollider> touched) {
    std::vector<std::vector<int>> rigidAt(x1_.size());  // (points) bodies, by their first surface
    const auto surfacesFrom = [&](int first) {
        std::vector<int> all;
        for (int k = first; isOfBody(k) && &bodyOf(k) == &bodyOf(first); ++k) all.push_back(k);
        return all;
    };
    for (std::size_t k = 0; k < bodies_.size(); ++k)
        if (bodies_[k]->spec->isRigid() && (k == 0 || bodies_[k] != bodies_[k - 1]))
            for (const int i : bodies_[k]->pointOf)
                rigidAt[static_cast<std::size_t>(offsets[k] + i)].push_back(static_cast<int>(k));
    std::set<std::pair<int, int>> joined;
    std::set<std::pair<int, std::string>> mounted;
    const auto join = [&](int a, int b) {
        for (const int own : rigidAt[static_cast<std::size_t>(a)])
            for (const int other : rigidAt[static_cast<std::size_t>(b)])
                if (own != other) joined.emplace(own, other);
    };
    const auto mount = [&](int point, const std::string& holder) {
        for (const int own : rigidAt[static_cast<std::size_t>(point)])
            mounted.emplace(own, parseCollider(holder).collider);
    };
    for (const Part& part : parts_) {
        const IslandPlan& plan = part.island->plan();
        for (int i = part.first; i < part.last; ++i) join(i, i);  // a merged point
        for (const JointTie& tie : plan.ties) {
            if (tie.touch || !holds(plan, tie)) continue;
            if (tie.b >= 0) join(part.first + tie.a, part.first + tie.b);
            const auto pins = [&](const JointTie::Part& own) {
                const Constraint* constraint = plan.constraints[static_cast<std::size_t>(own.constraint)].get();
                return dynamic_cast<const Pins*>(constraint) != nullptr;
            };
            if (!tie.collider.empty() && std::any_of(tie.parts.begin(), tie.parts.end(), pins))
                mount(part.first + tie.a, tie.collider);
        }
        for (const Grip& grip : plan.grips)
            for (const int i : grip.points)
                if (grip.ofCollider && grip.rigid) mount(part.first + i, grip.holder);
    }
    for (const auto& [first, second] : joined)
        for (const int own : surfacesFrom(first))
            for (const int other : surfacesFrom(second)) group_->elements().keepApart(own, other);
    for (const auto& [first, collider] : mounted)
        for (const int own : surfacesFrom(first)) {
            for (std::size_t c = 0; c < touched.size(); ++c)
                if (touched[c].name == collider) mountedOn_.emplace(own, static_cast<int>(c));
            for (const int other : colliders_.surfacesOf(collider)) group_->elements().keepApart(own, other);
        }
}

std::optional<std::pair<int, int>> ContactStage::sidesOf(const contact::Crossing& crossing) const {
    int a = elements().edges()[static_cast<std::size_t>(crossing.edge)].surface;
    int b = elements().triangles()[static_cast<std::size_t>(crossing.triangle)].surface;
    if (elements().isRigid(a)) return std::nullopt;
    if (!isOfBody(a) || (isOfBody(b) && sortsBefore(bodyOf(b), bodyOf(a)))) std::swap(a, b);
    return std::pair{a, b};
}

double ContactStage::depthOf(const contact::Crossing& crossing) const {
    const auto at = [&](std::size_t k) { return position(crossing.points[k]); };
    const dvec3 normal = glm::cross(at(3) - at(2), at(4) - at(2));
    const double size = std::sqrt(glm::dot(normal, normal));
    if (!(size > 0)) return 0;
    const double a = std::abs(glm::dot(normal, at(0) - at(2))), b = std::abs(glm::dot(normal, at(1) - at(2)));
    return std::min(a, b) / size;
}

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

// Takes over which triangles and edges damage has removed since the last time.
void ContactStage::takeDamage() {
    bool isOther = false;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const Body& body = *bodies_[s];
        const std::size_t severed = body.damage.edges().size();
        const std::vector<int>& points = group_->elements().surface(static_cast<int>(s)).points;
        if (severed == damage_[s] || (!points.empty() && group_->carried().has(points.front()))) continue;
        damage_[s] = severed;
        isOther = true;
        int offset = 0;
        for (const Part& part : parts_)
            if (part.island == body.island) offset = part.first;
        // Points of the body by their number in the island.
        std::vector<int> own(static_cast<std::size_t>(body.island->plan().points.size()), -1);
        for (std::size_t i = 0; i < body.pointOf.size(); ++i)
            own[static_cast<std::size_t>(body.pointOf[i])] = static_cast<int>(i);
        group_->elements().setGone(
            static_cast<int>(s), [&](std::size_t triangle) { return body.damage.isTriangleGone(triangle); },
            [&](int a, int b) {
                return body.damage.isSevered(own[static_cast<std::size_t>(a - offset)],
                                             own[static_cast<std::size_t>(b - offset)]);
            });
    }
    if (!isOther) return;
    group_->elements().refresh();
    drop();
}

void ContactStage::readAll() {
    for (const Part& part : parts_) {
        const auto first = static_cast<std::size_t>(part.first), count = static_cast<std::size_t>(part.last) - first;
        part.island->read(std::span(x1_).subspan(first, count), std::span(v_).subspan(first, count));
    }
    group_->carried().follow(x1_, v_);
}

int ContactStage::commonSubsteps() const {
    int common = 0;
    for (const Island* island : islands_)
        if (!island->isStill()) common = std::gcd(common, island->substeps());
    return std::max(common, 1);
}

// Whether bodies of an island give back a part of an impact among themselves.
bool ContactStage::bounces(const Island& island) const {
    return spec_.restitution > 0 &&
           std::any_of(
               island.plan().bodies.begin(), island.plan().bodies.end(),
               [](const Body* body) { return body->spec->facesMeet() && body->spec->restitution > 0; });
}

// How many steps any body may need, whatever touches.
int ContactStage::mostSteps() const {
    int most = fewest_;
    for (const Island* island : islands_)
        if (!island->isStill()) most = std::max(most, island->stepsToPress(bounces(*island)));
    return most;
}

// Makes the islands' substeps a multiple of the pace, which has room for `steps` -> steps_, these or a few more.
void ContactStage::takeSteps(const TickTime& time, int steps) {
    room_ = steps;
    if (pace_.isExceededBy(room_)) pace_.shorten(room_);
    for (Island* island : islands_) island->takeParts(time, pace_.substeps());
    const int common = commonSubsteps();
    steps_ = std::min(steps, common);
    while (common % steps_ != 0) ++steps_;
}

// Whether a surface may meet anything in this tick, by boxes (surfaces) of ways.
bool ContactStage::isNearAny(int surface, std::span<const core::Aabb> boxes) const {
    if (elements().surface(surface).meetsItself || elements().surface(surface).meetsShapes ||
        bodyOf(surface).spec->meetsCollidersAsWhole())
        return true;
    for (std::size_t other = 0; other < boxes.size(); ++other)
        if (static_cast<int>(other) != surface && elements().mayTouch(surface, static_cast<int>(other)) &&
            boxes[other].overlaps(boxes[static_cast<std::size_t>(surface)], 0.0))
            return true;
    return false;
}

// The number of steps of the tick: as many as the stiffest body needs that may meet another -> steps_.
void ContactStage::chooseSteps(const TickTime& time) {
    const std::vector<contact::ContactSurface>& surfaces = elements().surfaces();
    std::vector<core::Aabb> boxes(surfaces.size());
    std::vector<double> speeds(surfaces.size(), 0.0);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        for (const int i : surfaces[s].points) {
            const auto k = static_cast<std::size_t>(i);
            boxes[s].add(x1_[k]);
            boxes[s].add(x1_[k] + tickSeconds_ * v_[k]);
            speeds[s] = std::max(speeds[s], glm::dot(v_[k], v_[k]));
        }
        boxes[s].grow(2 * surfaces[s].thickness);
    }
    int steps = 1;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const Island& island = *bodies_[s]->island;
        if (island.isStill() || !isNearAny(static_cast<int>(s), boxes)) continue;
        steps = std::max(steps, island.stepsToPress(bounces(island)));
        const double way = mostWay * surfaces[s].thickness, speed = std::sqrt(speeds[s]);
        while (steps < mostStepsForSpeed && tickSeconds_ * speed > steps * way) steps *= 2;
    }
    takeSteps(time, steps);
}

// What is still has no inverse mass. Surfaces that sleep, or have slept until now, are told apart.
void ContactStage::takeMasses() {
    for (const Part& part : parts_) {
        const IslandPlan& plan = part.island->plan();
        for (int i = part.first; i < part.last; ++i) {
            const int own = i - part.first;
            const bool moves = !part.island->isStill() && isFree(plan, own);
            inverseMass_[static_cast<std::size_t>(i)] =
                moves ? 1.0 / plan.points[static_cast<std::size_t>(own)].mass : 0.0;
        }
    }
    if (!solids_.empty()) takeSolids();
    const contact::CarriedPoints& carried = group_->carried();
    for (int i = carried.first(); i < carried.end(); ++i) {
        double& inverse = inverseMass_[static_cast<std::size_t>(i)] = 0.0;
        carried.forEachMover(i, [&](int mover, double weight) {
            inverse += weight * weight * inverseMass_[static_cast<std::size_t>(mover)];
        });
    }
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const int surface = static_cast<int>(s);
        const bool isAsleep = bodies_[s]->island->isAsleep();
        if (group_->elements().isStill(surface) == isAsleep) continue;
        group_->elements().setStill(surface, isAsleep);
        hasJumped_ = true;
    }
}

// A free point of a solid weighs what all of the solid does. A held one is so heavy that the solid turns about it.
void ContactStage::takeSolids() {
    std::vector<contact::Solid> solids;
    std::vector<double> inverses;
    for (const std::vector<int>& points : solids_) {
        contact::Solid& solid = solids.emplace_back();
        solid.points = points;
        inverses.clear();
        for (int i : points) inverses.push_back(inverseMass_[static_cast<std::size_t>(i)]);
        const double mass = core::massesOf(inverses, solid.masses);
        solid.moves = mass > 0;
        for (int i : points)
            if (double& inverse = inverseMass_[static_cast<std::size_t>(i)]; inverse > 0) inverse = 1.0 / mass;
    }
    group_->setSolids(std::move(solids));
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
    for (const RigidTouch& touch : rigidTouches_) {
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

// Updates damage, masses, colliders and places.
void ContactStage::beginTick(const TickTime& time, std::span<const ColliderMotion> moving) {
    for (Island* island : islands_) {
        island->takeParts(time, pace_.substeps());
        island->beginTick(time);
    }
    areCrossingsKnown_ = false;
    weight_ = 0;
    for (const Island* island : islands_) {
        const dvec3 gravity = island->dynamics().gravity(time.start());
        weight_ = std::max(weight_, std::sqrt(glm::dot(gravity, gravity)));
    }
    takeDamage();
    takeMasses();
    hasJumped_ = colliders_.move(moving, time.end(), tickSeconds_, group_->elements(), v_) || hasJumped_;
    convex_.move(moving, tickSeconds_);
    readAll();
    colliders_.place(0.0, x1_);
    if (hasJumped_) group_->drop();
    hasJumped_ = false;
}

std::optional<ContactStage::Outcome> ContactStage::tick(const TickTime& time, std::span<const ColliderMotion> moving,
                                                        bool watchesFriction) {
    if (isAtRest()) {
        hasJumped_ = colliders_.move(moving, time.end(), tickSeconds_, group_->elements(), v_) || hasJumped_;
        convex_.move(moving, tickSeconds_);
        return std::nullopt;
    }
    beginTick(time, moving);

    // Crossings, and the number of steps. An island that keeps its step needs the largest number from the first tick.
    const auto start = Clock::now();
    group_->begin(x1_);
    if (anySleeps()) wakeCrossed(time);
    if (islands_.front()->keepsStep())
        takeSteps(time, mostSteps());
    else
        chooseSteps(time);
    total_.seconds += secondsSince(start);

    // Tries until one stands.
    for (;;) {
        std::vector<std::optional<Fault>> faults(islands_.size());
        for (Island* island : islands_) island->beginTry();
        readAll();
        colliders_.place(0.0, x1_);
        presses_.assign(watchesFriction ? x1_.size() : 0, {});
        pressing_.clear();
        footholds_.clear();
        reached_.clear();
        takeBlocks(time, moving, faults);
        std::vector<TickVerdict> verdicts(islands_.size(), TickVerdict::stands);

        // Judges the try. Each island has a say. If one diverged it may be frozen, and the others go on beside it.
        bool isAgain = !reached_.empty();
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            if (!reached_.empty()) continue;
            verdicts[k] = islands_[k]->judge(time, faults[k]);
            if (verdicts[k] == TickVerdict::fails) {
                if (islands_[k]->plan().solver.onDivergence != OnDivergence::freeze)
                    return Outcome{islands_[k], *faults[k]};
                islands_[k]->freeze(*faults[k], time);
                verdicts[k] = TickVerdict::stands;
                const Part& part = parts_[k];
                std::fill(inverseMass_.begin() + part.first, inverseMass_.begin() + part.last, 0.0);
                isAgain = true;
            }
            isAgain = isAgain || verdicts[k] == TickVerdict::again;
        }
        if (!isAgain) break;

        // Goes back to the start of the tick.
        for (std::size_t k = 0; k < islands_.size(); ++k) islands_[k]->tryAgain(time, verdicts[k]);
        readAll();
        colliders_.place(0.0, x1_);
        group_->rewind(xStart_, x1_);
        if (!reached_.empty()) wake(time, reached_);
        if (!islands_.front()->keepsStep()) chooseSteps(time);
    }

    // Ends the tick.
    for (Island* island : islands_) island->endTick(time);
    reportAccelerations();
    pace_.lengthenIfCalm(islands_.front()->keepsStep() ? mostSteps() : room_);
    total_.detections += blocks_;
    mostBlocks_ = std::max(mostBlocks_, blocks_);
    ++total_.ticks;
    return std::nullopt;
}

// Wakes companies within the tick, at its start.
void ContactStage::wake(const TickTime& time, std::span<const std::int64_t> companies) {
    for (Island* island : islands_) {
        if (!island->isAsleep() || std::count(companies.begin(), companies.end(), island->company()) == 0) continue;
        island->wake();
        island->close(time);
        island->takeParts(time, pace_.substeps());
        island->beginTick(time);
    }
    takeMasses();
    readAll();
    colliders_.place(0.0, x1_);
    if (hasJumped_) group_->drop();
    hasJumped_ = false;
}

// What crosses a body that is awake has to make way for it.
void ContactStage::wakeCrossed(const TickTime& time) {
    reached_.clear();
    for (const contact::Crossing& crossing : group_->crossings()) {
        const auto& elements = group_->elements();
        addReached(elements.edges()[static_cast<std::size_t>(crossing.edge)].surface,
                   elements.triangles()[static_cast<std::size_t>(crossing.triangle)].surface);
    }
    if (!reached_.empty()) wake(time, reached_);
}

// Of two surfaces that meet: if one sleeps and the other is of a body that moves, the first has been reached.
void ContactStage::addReached(int surfaceA, int surfaceB) {
    if (!isOfBody(surfaceA) || !isOfBody(surfaceB)) return;
    const Island &a = *bodyOf(surfaceA).island, &b = *bodyOf(surfaceB).island;
    if (a.isAsleep() && !b.isStill()) reached_.push_back(a.company());
    if (b.isAsleep() && !a.isStill()) reached_.push_back(b.company());
}

bool ContactStage::findReached() {
    group_->forEachPressing([&](const contact::ContactConstraint& pair, double, const dvec3&) {
        addReached(elements().surfaceOf(pair.points[0]), elements().surfaceOf(pair.points[3]));
    });
    return !reached_.empty();
}

// Adds up the impulses of pairs on points in this step, and of colliders on those of whole bodies.
void ContactStage::addPresses() {
    const auto add = [&](int point, double share, double limit, const dvec3& push, const dvec3& friction) {
        group_->carried().forEachMover(
            point,
            [&](int i, double weight) {
                Press& press = presses_[static_cast<std::size_t>(i)];
                press.limit += std::abs(share * weight) * limit;
                press.push += share * weight * push;
                press.friction += share * weight * friction;
            });
    };
    group_->forEachOnCollider([&](std::size_t k, double normal, const dvec3& friction) {
        const contact::KinematicContact& contact = kinematic_[k];
        if (!contact.isWhole) return;
        contact.forEachPoint([&](int point, double weight) {
            add(point, weight, contact.friction * normal, normal * contact.normal, friction);
        });
    });
    group_->forEachPressing([&](const contact::ContactConstraint& pair, double normal, const dvec3& friction) {
        for (std::size_t k = 0; k < 4; ++k)
            add(pair.points[k], pair.weights[k], pair.friction * normal, normal * pair.normal, friction);
        const int a = elements().surfaceOf(pair.points[0]), b = elements().surfaceOf(pair.points[3]);
        if (!isOfBody(a) || !isOfBody(b)) return;
        const std::pair<const Island*, const Island*> islands{bodyOf(a).island, bodyOf(b).island};
        if (islands.first != islands.second && std::count(pressing_.begin(), pressing_.end(), islands) == 0)
            pressing_.push_back(islands);
    });
}

void ContactStage::addFootholds() {
    group_->forEachPressing([&](const contact::ContactConstraint& pair, double normal, const dvec3& friction) {
        for (const int from : {0, pair.firstSide()}) {
            const int surface = elements().surfaceOf(pair.points[static_cast<std::size_t>(from)]);
            if (!isOfBody(surface) || !bodyOf(surface).spec->isRigid()) continue;
            dvec3 place(0.0);
            for (int k = from; k < (from == 0 ? pair.firstSide() : 4); ++k) {
                const auto own = static_cast<std::size_t>(k);
                place += std::abs(pair.weights[own]) * x1_[static_cast<std::size_t>(pair.points[own])];
            }
            footholds_[bodyOf(surface).island].push_back({pair.places ? (*pair.places)[from == 0 ? 0 : 1] : place,
                                                          glm::length(friction), pair.friction * normal,
                                                          pair.turnFriction.rolling > 0, false});
        }
    });
    group_->forEachOnCollider([&](std::size_t k, double normal, const dvec3& friction) {
        const contact::KinematicContact& contact = kinematic_[k];
        if (!contact.isWhole || !(normal > 0)) return;
        const dvec3 place = x1_[static_cast<std::size_t>(contact.point())] + contact.arm;
        footholds_[bodyOf(elements().surfaceOf(contact.point())).island].push_back(
            {place, glm::length(friction), contact.friction * normal, contact.turnFriction.rolling > 0, true});
    });
}

std::vector<Island::Support> ContactStage::supports(const Island& island) const {
    std::vector<Island::Support> supports(island.plan().points.size());
    for (const Part& part : parts_) {
        if (part.island != &island || presses_.empty()) continue;
        for (int i = part.first; i < part.last; ++i) {
            const auto& [limit, push, friction] = presses_[static_cast<std::size_t>(i)];
            const double most = stickingShare * limit;
            supports[static_cast<std::size_t>(i - part.first)] = {
                push, limit > 0 && glm::dot(friction, friction) <= most * most};
        }
    }
    return supports;
}

bool ContactStage::crosses(const Island& island) const {
    const auto isOwn = [&](int surface) { return isOfBody(surface) && bodyOf(surface).island == &island; };
    const auto crossings = crossingsBefore();
    return std::any_of(crossings.begin(), crossings.end(), [&](const contact::Crossing& crossing) {
        return isOwn(elements().edges()[static_cast<std::size_t>(crossing.edge)].surface) ||
               isOwn(elements().triangles()[static_cast<std::size_t>(crossing.triangle)].surface);
    });
}

bool ContactStage::anySleeps() const {
    return std::any_of(
        islands_.begin(), islands_.end(), [](const Island* island) { return island->isAsleep(); });
}

bool ContactStage::movesAny() const {
    return std::any_of(
        islands_.begin(), islands_.end(), [](const Island* island) { return !island->isStill(); });
}

// One try of the tick, block by block. Ends early on a fault, and where something that sleeps is reached.
void ContactStage::takeBlocks(const TickTime& time, std::span<const ColliderMotion> moving,
                              std::vector<std::optional<Fault>>& faults) {
    blocks_ = 0;
    const int wanted = spec_.detections.value_or(std::max(1, fewest_ / stepsOfBlock)),
              usual = (steps_ + wanted - 1) / wanted;
    for (int first = 0, last = 0, longest = usual; first < steps_; first = last, ++blocks_) {
        xStart_ = x1_;
        last = std::min(first + longest, steps_);
        for (int step = first; step < last; ++step) {
            std::swap(x0_, x1_);
            vStart_ = v_;
            if (!advance(time, moving, step, step + 1, faults)) return;
            if (step == first) last = first + openBlock(step, last - first, usual);
            // Without rows there are no impulses until the block ends.
            if (!group_->hasRows()) {
                pressed_.clear();
                if (step + 1 < last && !advance(time, moving, step + 1, last, faults)) return;
                break;
            }
            vBefore_ = v_;
            group_->step({x0_, x1_, v_, vStart_});
            if (!presses_.empty()) addPresses();
            if (!presses_.empty() && !wholes_.empty()) addFootholds();
            if (anySleeps() && findReached()) return;
            takeAccelerations();
            settle();
            if (findFaults(time.at(step + 1, steps_), faults)) return;
            if (group_->hasBounced()) last = step + 1;  // it does not go where it was expected
        }
        closeBlock();
        xStart_ = x1_;
        if (findFaults(time.at(last, steps_), faults)) return;
        const int calm = mostGrowth * usual;
        longest = !spec_.detections && !mayRoll() && group_->wayOfStep() * calm < calmWay ? calm : usual;
    }
}

// Whether a body in contact may roll.
bool ContactStage::mayRoll() const {
    return !rigidPairs_.empty() ||
           std::any_of(
               kinematic_.begin(), kinematic_.end(),
               [](const auto& contact) { return contact.isWhole && contact.used().size() == 1; });
}

// The islands take these steps without contact. Returns false on a fault.
bool ContactStage::advance(const TickTime& time, std::span<const ColliderMotion> moving, int first, int last,
                           std::vector<std::optional<Fault>>& faults) {
    core::parallelFor(
        static_cast<int>(islands_.size()), [&](int k) { return islands_[static_cast<std::size_t>(k)]->callsBack(); },
        [&](int k) {
            const auto own = static_cast<std::size_t>(k);
            for (int step = first; step < last && !faults[own]; ++step)
                faults[own] = islands_[own]->advance(time, moving, step, steps_);
        });
    if (std::any_of(faults.begin(), faults.end(), [](const auto& fault) { return fault.has_value(); })) return false;
    readAll();
    colliders_.place(static_cast<double>(last) / steps_, x1_);
    return true;
}

// Begins a block of so many steps, after the first of them, which tells where all of them lead. Returns how many it
// has: fewer where something is fast.
int ContactStage::openBlock(int step, int steps, int usual) {
    const auto start = Clock::now();
    const double h = tickSeconds_ / steps_;
    const auto lookAhead = [&](double ahead) {
        ahead_.resize(x1_.size());
        for (std::size_t i = 0; i < ahead_.size(); ++i) ahead_[i] = x0_[i] + ahead * (x1_[i] - x0_[i]);
    };
    lookAhead(steps);
    kinematic_.clear();
    for (const Part& part : parts_)
        for (const collision::Contact& c :
             part.island->isStill() ? std::span<const collision::Contact>{} : part.island->contacts())
            kinematic_.push_back({.points = {part.first + c.point, -1, -1},
                                  .normal = c.normal,
                                  .speed = glm::dot(c.normal, c.carried),
                                  .carried = c.carried,
                                  .friction = c.friction});
    if (!wholes_.empty()) addWholeContacts(h, (steps - 1) * h);
    const double from = static_cast<double>(step) / steps_;
    findTouches(x0_, ahead_, from, std::min(1.0, from + static_cast<double>(steps) / steps_));
    addTouches();
    const int longest = steps;
    if (mayRoll()) steps = std::min(steps, usual);  // normals turn with what rolls
    for (const ElementTouch& touch : elementTouches_)
        if (const double most = (touch.solid < 0 ? calmWay : mostWayOnSolid) * touch.thickness;
            touch.speed * h * steps > most)
            steps = std::max(1, static_cast<int>(most / (touch.speed * h)));
    if (steps < longest) lookAhead(steps);
    std::stable_sort(kinematic_.begin(), kinematic_.end(),
                     [](const auto& a, const auto& b) { return a.point() < b.point(); });
    contact::Block block;
    block.h = h;
    block.steps = steps;
    block.x0 = xStart_;
    block.ahead = ahead_;
    block.inverseMass = inverseMass_;
    block.kinematic = kinematic_;
    block.rigid = rigidPairs_;
    block.restSpeed = 2.0 * weight_ * steps * h;  // as with colliders
    block.place = [this](std::span<const int> points) { place(points); };
    block.mostWay = spec_.restitution > 0 ? calmWay : mostWay;
    const int taken = group_->open(block);
    total_.testedPairs += static_cast<std::int64_t>(group_->testedCount());
    total_.seconds += secondsSince(start);
    return taken;
}

void ContactStage::closeBlock() {
    const auto start = Clock::now();
    constexpr int mostRounds = 4;
    bool moves = group_->close(x1_, v_);
    // The certificate has the last word; the next step brings together what it has pulled off a constraint.
    for (int round = 0; round < mostRounds && moves && settle(); ++round) moves = group_->certify(x1_, v_);
    group_->finish(x1_);
    const contact::BlockResult& result = group_->result();
    hadImpulse_ = hadImpulse_ || result.impulses > 0;
    total_.slides += result.slides;
    total_.zones += result.zones;
    total_.uncertified += result.uncertified;
    total_.seconds += secondsSince(start);
}

// Islands place the points that contact moved and return where these came to be.
void ContactStage::place(std::span<const int> points) {
    std::vector<int> own;
    std::vector<dvec3> x, v;
    for (const Part& part : parts_) {
        const auto first = std::lower_bound(points.begin(), points.end(), part.first);
        const auto last = std::lower_bound(first, points.end(), part.last);
        if (first == last) continue;
        own.clear();
        x.clear();
        v.clear();
        for (auto i = first; i != last; ++i) {
            own.push_back(*i - part.first);
            x.push_back(x1_[static_cast<std::size_t>(*i)]);
            v.push_back(v_[static_cast<std::size_t>(*i)]);
        }
        part.island->place(own, x, v);
        for (std::size_t k = 0; k < own.size(); ++k) {
            x1_[static_cast<std::size_t>(own[k] + part.first)] = x[k];
            v_[static_cast<std::size_t>(own[k] + part.first)] = v[k];
        }
    }
}

// Constraints inside islands share the changes by contact, which moves further points.
bool ContactStage::settle() {
    bool hasMoved = false;
    for (const Part& part : parts_) {
        if (!part.island->settle()) continue;
        hasMoved = true;
        const auto first = static_cast<std::size_t>(part.first), count = static_cast<std::size_t>(part.last) - first;
        part.island->read(std::span(x1_).subspan(first, count), std::span(v_).subspan(first, count));
    }
    if (hasMoved) group_->carried().follow(x1_, v_);
    return hasMoved;
}

// Whether contact gave a point a place or velocity that is not finite or too fast: a fault of its island.
bool ContactStage::findFaults(double t, std::vector<std::optional<Fault>>& faults) const {
    bool areAny = false;
    for (int i : group_->result().moved) {
        const dvec3 &x = x1_[static_cast<std::size_t>(i)], &v = v_[static_cast<std::size_t>(i)];
        const double square = glm::dot(v, v);
        const bool isNumber = std::isfinite(square + glm::dot(x, x));
        if (isNumber && square < mechanics::speedLimit * mechanics::speedLimit) continue;
        for (std::size_t k = 0; k < parts_.size(); ++k)
            if (i >= parts_[k].first && i < parts_[k].last && !faults[k])
                faults[k] = Fault{.point = i - parts_[k].first, .time = t, .isNumber = isNumber, .byContact = true};
        areAny = true;
    }
    return areAny;
}

// The accelerations by contact in this step, before constraints share them -> pressed_.
void ContactStage::takeAccelerations() {
    pressed_.clear();
    for (const int i : group_->result().moved) {
        const auto k = static_cast<std::size_t>(i);
        pressed_.push_back({i, (v_[k] - vBefore_[k]) * (steps_ / tickSeconds_)});
    }
}

// Gives the islands those of the last step.
void ContactStage::reportAccelerations() {
    std::vector<ContactAcceleration> own;
    auto next = pressed_.begin();
    for (const Part& part : parts_) {
        own.clear();
        for (; next != pressed_.end() && next->point < part.last; ++next)
            own.push_back({next->point - part.first, next->acceleration});
        part.island->bear(own);
    }
}

ContactInfo ContactStage::info() const {
    ContactInfo info = total_;
    if (isEmpty()) return info;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        info.bodies.push_back(bodies_[s]->fullName());
        const int surface = static_cast<int>(s);
        info.surfaces.push_back({elements().surface(surface).thickness, elements().shortestEdge(surface)});
    }
    info.points = static_cast<int>(x1_.size());
    info.mostDetections = mostBlocks_;
    info.lastDetections = blocks_;
    info.lastTestedPairs = static_cast<int>(group_->testedCount());
    info.lastImpulses = group_->result().impulses;
    info.candidateLists = static_cast<std::int64_t>(group_->listsMade());
    info.bytes = group_->bytes();
    return info;
}

std::vector<int> ContactStage::squeezed() const {
    std::vector<int> points;
    for (const auto& [point, rank] : group_->squeezed()) points.push_back(point);
    return points;
}

std::vector<contact::ContactPoint> ContactStage::contacts() const {
    if (isEmpty()) return {};
    std::vector<contact::ContactPoint> all = group_->contactPoints(x1_);
    group_->forEachOnCollider([&](std::size_t k, double normal, const dvec3&) {
        const contact::KinematicContact& own = kinematic_[k];
        if (!own.isWhole) return;
        const dvec3 place = x1_[static_cast<std::size_t>(own.point())] + own.arm;
        all.push_back({place, own.normal, normal, elements().surfaceOf(own.point()), noSurface});
    });
    return all;
}

std::span<const contact::Crossing> ContactStage::crossingsBefore() const {
    if (isEmpty()) return {};
    return group_->crossings();
}

const std::vector<contact::Crossing>& ContactStage::crossings() {
    if (isEmpty()) return crossings_;
    takeDamage();
    if (areCrossingsKnown_) return crossings_;
    if (hasJumped_) group_->drop();
    hasJumped_ = false;
    readAll();
    crossings_ = group_->crossingsAt(x1_);
    areCrossingsKnown_ = true;
    return crossings_;
}

}  // namespace taut::world
