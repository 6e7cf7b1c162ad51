#include "taut/world/private/contact_stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "taut/bodies/joints/constraint.h"
#include "taut/bodies/private/carried_surface.h"
#include "taut/contact/penetration.h"
#include "taut/contact/rigid_side.h"
#include "taut/core/private/parallel.h"
#include "taut/core/rigid_motion.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

constexpr double longestInstant = 1.1e-3;  // [s] of a tick with contact
constexpr int mostInstantsForSpeed = 64;   // in a tick, for fast motion
constexpr int fewerForSolids = 4;          // times
// In one instant, as shares of the thickness:
constexpr double mostDeformation = 4.0;  // mean deformation of leaves, in a tick without contact
constexpr double mostClosing = 0.35;     // closing of a pair
constexpr double mostClosingOfSolids = 4.0;
constexpr double mostFurther = 0.1;    // into a collider, off another
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

int fewestInstants(double tickSeconds) {
    int instants = 1;
    while (instants < mostInstantsForSpeed && tickSeconds / instants > longestInstant) instants *= 2;
    return instants;
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
    : spec_(spec), tickSeconds_(1.0 / now.ticksPerSecond), fewest_(fewestInstants(tickSeconds_)), pace_(pace) {
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
            if (!holds(plan, tie)) continue;
            if (tie.b >= 0) join(part.first + tie.a, part.first + tie.b);
            const auto carries = [&](const JointTie::Part& own) {
                return plan.constraints[static_cast<std::size_t>(own.constraint)]->carries(tie.a);
            };
            if (!tie.collider.empty() && std::any_of(tie.parts.begin(), tie.parts.end(), carries))
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
            all.deepest = std::max(all.deepest, -touch.gap - elements().surface(touch.surface).thickness);
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

// How many instants bodies with these surfaces need while they press. The rest of the group does not matter.
int ContactStage::instantsFor(std::span<const int> surfaces) const {
    int needed = 1;
    for (int s : surfaces)
        if (isOfBody(s) && !bodyOf(s).island->isStill()) needed = std::max(needed, bodyOf(s).island->instantsToPress());
    return needed;
}

// Solids that meet only their like have no springs for which an instant could be too long, and rows close their gaps.
// Where nothing is said to meet, anything may.
bool ContactStage::areSolid(std::span<const int> surfaces) const {
    const auto isSolid = [](const Body* body) { return body->spec->isRigid(); };
    if (!crossingsBefore().empty()) return false;
    if (surfaces.empty()) return std::all_of(bodies_.begin(), bodies_.end(), isSolid);
    return std::all_of(surfaces.begin(), surfaces.end(),
                       [&](int surface) { return !isOfBody(surface) || isSolid(&bodyOf(surface)); });
}
int ContactStage::fewestFor(std::span<const int> surfaces) const {
    return areSolid(surfaces) ? std::max(fewest_ / fewerForSolids, 1) : fewest_;
}
double ContactStage::mostClosingOf(std::span<const int> surfaces) const {
    return areSolid(surfaces) ? mostClosingOfSolids : mostClosing;
}

// How many instants any body may need, whatever touches.
int ContactStage::mostInstants() const {
    int most = spec_.instants.value_or(fewest_);
    if (!spec_.instants)
        for (const Island* island : islands_)
            if (!island->isStill()) most = std::max(most, island->instantsToPress());
    return most;
}

// Makes the islands' substeps a multiple of the pace, which has room for all instants that these surfaces may need. So
// steps do not change while they press. Returns the number of instants: `needed`, or a few more so that it divides all
// substeps.
int ContactStage::takeInstants(const TickTime& time, int needed, std::span<const int> pressed) {
    room_ = spec_.instants ? needed : std::max(needed, instantsFor(pressed));
    if (pace_.isExceededBy(room_)) pace_.shorten(room_);
    for (Island* island : islands_) island->takeParts(time, pace_.substeps());
    const int common = commonSubsteps();
    int instants = std::min(needed, common);
    while (common % instants != 0) ++instants;
    return instants;
}

// The number of instants of the tick. Negative: for a trial, in which nothing should touch.
int ContactStage::chooseInstants(const TickTime& time, std::span<const ColliderMotion> moving) {
    if (spec_.instants) return takeInstants(time, *spec_.instants);
    for (Island* island : islands_) island->moveColliders(moving, 0);  // they stand where the last try has left them
    contact::Forecast forecast = group_->forecast(x1_, v_, inverseMass_, 1.0 / time.ticksPerSecond / fewest_);
    foreseeWholes(forecast);
    // Doubles instants until a motion of that speed goes at most `way` in one.
    const auto enough = [&](int instants, double speed, double way) {
        while (instants < mostInstantsForSpeed && tickSeconds_ * speed > instants * way) instants *= 2;
        return instants;
    };
    // No contact: the cheapest number for the broad phase.
    if (!forecast.isInContact) {
        const int common = commonSubsteps();
        return -takeInstants(time, std::min(common, enough(1, forecast.deformationRate, mostDeformation)));
    }
    const double way = mostClosingOf(forecast.surfaces) * forecast.leastThickness;
    return takeInstants(time, enough(fewestFor(forecast.surfaces), forecast.closing, way), forecast.surfaces);
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

// The contacts of whole bodies with colliders at the end of an instant h [s] long -> kinematic_.
void ContactStage::addWholeContacts(double h) {
    forEachNearCollider(
        h, 0.0,
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
            contact.arm = -thickness * surface.away;
            // Where it came from, so that what it goes in this instant is no overlap.
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

// -> kinematic_, rigidPairs_, deepestTouch_.
void ContactStage::addTouches() {
    rigidPairs_.clear();
    deepestTouch_ = 0;
    const auto pointOf = [&](int surface) { return elements().surface(surface).points.front(); };
    const auto deepen = [&](double way, double gap, double thickness) {
        deepestTouch_ = std::max(deepestTouch_, (way - std::max(gap, 0.0)) / thickness);
    };
    // Of a collider, with a body that has this point.
    const auto add = [&](int collider, int point, const dvec3& normal, const dvec3& place, const dvec3& velocity,
                         double gap) -> contact::KinematicContact& {
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
        contact.arm = place - x0_[static_cast<std::size_t>(point)];
        contact.restitution = material.restitution * spec.restitution;
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
        pair.isPoint = pair.isActive = true;
        return pair;
    };
    for (const RigidTouch& touch : rigidTouches_) {
        deepen(touch.way, touch.gap, touch.thickness);
        const int a = pointOf(touch.surface);
        if (touch.other < 0) {
            add(touch.collider, a, touch.normal, touch.onFirst, touch.velocity, touch.gap);
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
        deepen(touch.way, touch.gap, touch.thickness);
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
                touch.velocity, touch.gap);
        contact.points = touch.points;
        contact.weights = touch.weights;
        if (!contact::mayYield(contact.used(), std::span(contact.weights).first(contact.used().size()), inverseMass_))
            kinematic_.pop_back();
    }
}

// How much deeper whole bodies that met a collider in this instant have come into another, or another side of it, over
// the thickness: what they bounced or slid off may have sent them there.
double ContactStage::furtherIntoColliders(double h) const {
    constexpr double alike = 0.5;
    std::map<const Island*, std::vector<dvec3>> met;  // normals
    group_->forEachOnCollider([&](std::size_t k, double, const dvec3&) {
        const contact::KinematicContact& contact = kinematic_[k];
        if (contact.isWhole) met[bodyOf(elements().surfaceOf(contact.point())).island].push_back(contact.normal);
    });
    if (met.empty() || spec_.instants || instants_ >= mostInstantsForSpeed) return 0;
    double most = 0;
    forEachNearCollider(
        h, 0.0,
        [&](int i, const BodySpec&, double thickness, const collision::Colliders::Surface& surface) {
            const auto k = static_cast<std::size_t>(i);
            const double gap = surface.distance - thickness;
            const double before = gap + glm::dot(surface.away, x0_[k] - x1_[k] + h * surface.velocity);
            const double further = (std::min(before, 0.0) - gap) / thickness;
            const auto isKnown = [&](const dvec3& normal) { return glm::dot(normal, surface.away) > alike; };
            const std::vector<dvec3>& own = met.at(bodyOf(elements().surfaceOf(i)).island);
            if (further > most && std::none_of(own.begin(), own.end(), isKnown)) most = further;
        },
        [&](int whole) { return met.contains(bodyOf(whole).island); });
    return most;
}

// Whole bodies meet colliders, and solids turn and roll, in no fewer instants than bodies that press each other.
void ContactStage::foreseeTouches(contact::Forecast& forecast) {
    if (rigid_.isEmpty() && convex_.isEmpty()) return;
    std::vector<dvec3> ahead(x1_);
    for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += tickSeconds_ * v_[i];
    findTouches(x1_, ahead, 0.0, 1.0);
    const auto foresee = [&](int surface, double gap, double way, double thickness) {
        if (gap > way) return false;
        forecast.isInContact = true;
        forecast.surfaces.push_back(surface);
        forecast.closing = std::max(forecast.closing, way / tickSeconds_);
        forecast.leastThickness = std::min(forecast.leastThickness, thickness);
        return true;
    };
    for (const RigidTouch& touch : rigidTouches_)
        if (foresee(touch.surface, touch.gap, touch.way, touch.thickness) && touch.other >= 0)
            forecast.surfaces.push_back(touch.other);
    for (const ElementTouch& touch : elementTouches_)
        if (touch.gap <= touch.way / fewest_ && foresee(touch.surface, touch.gap, touch.way, touch.thickness) &&
            touch.solid >= 0)
            forecast.surfaces.push_back(touch.solid);
}

void ContactStage::foreseeWholes(contact::Forecast& forecast) {
    for (const auto& [whole, thickness, points] : wholes_)
        if (bodyOf(whole).spec->isRigid() && !bodyOf(whole).island->isStill()) forecast.isInContact = true;
    forEachNearCollider(0.0, tickSeconds_,
                        [&](int i, const BodySpec&, double thickness, const collision::Colliders::Surface& surface) {
                            forecast.isInContact = true;
                            forecast.surfaces.push_back(elements().surfaceOf(i));
                            const dvec3 velocity = v_[static_cast<std::size_t>(i)] - surface.velocity;
                            forecast.closing = std::max(forecast.closing, -glm::dot(surface.away, velocity));
                            forecast.leastThickness = std::min(forecast.leastThickness, thickness);
                        });
    foreseeTouches(forecast);
    std::sort(forecast.surfaces.begin(), forecast.surfaces.end());
    forecast.surfaces.erase(std::unique(forecast.surfaces.begin(), forecast.surfaces.end()), forecast.surfaces.end());
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

    // Crossings, and the number of instants. An island that keeps its step needs the largest number from the first
    // tick.
    const auto start = Clock::now();
    group_->begin(x1_);
    if (anySleeps()) wakeCrossed(time);
    if (islands_.front()->keepsStep()) takeInstants(time, mostInstants());
    int instants = chooseInstants(time, moving);
    total_.seconds += secondsSince(start);

    // Tries until one stands.
    for (;;) {
        std::vector<std::optional<Fault>> faults(islands_.size());
        for (Island* island : islands_) island->beginTry();
        readAll();
        colliders_.place(0.0, x1_);
        const bool isTrial = instants < 0;
        instants_ = std::abs(instants);
        presses_.assign(watchesFriction ? x1_.size() : 0, {});
        pressing_.clear();
        footholds_.clear();
        reached_.clear();
        const bool isCoarse = tryTick(time, moving, instants_, faults, isTrial);
        std::vector<TickVerdict> verdicts(islands_.size(), TickVerdict::stands);

        // Judges the try. Each island has a say. If one diverged it may be frozen, and the others go on beside it.
        bool isAgain = isCoarse;
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            if (isCoarse) continue;
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

        // Goes back to the start of the tick and chooses a new number of instants.
        for (std::size_t k = 0; k < islands_.size(); ++k) islands_[k]->tryAgain(time, verdicts[k]);
        std::swap(x0_, x1_);
        readAll();
        colliders_.place(0.0, x1_);
        group_->rewind(x0_, x1_);
        if (!reached_.empty()) {
            wake(time, reached_);
            instants = chooseInstants(time, moving);
            continue;
        }
        instants = isCoarse
                       ? takeInstants(time, std::max({fewestFor(result_.surfaces), 2 * instants_, instantsToFollow()}),
                                      result_.surfaces)
                       : chooseInstants(time, moving);
    }

    // Ends the tick.
    for (Island* island : islands_) island->endTick(time);
    reportAccelerations();
    pace_.lengthenIfCalm(islands_.front()->keepsStep() ? mostInstants() : room_);
    total_.instants += instants_;
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

// Adds up what pairs press points with in this instant, and colliders those of whole bodies.
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
                                                          glm::length(friction), pair.friction * normal, false});
        }
    });
    group_->forEachOnCollider([&](std::size_t k, double normal, const dvec3& friction) {
        const contact::KinematicContact& contact = kinematic_[k];
        if (!contact.isWhole || !(normal > 0)) return;
        const dvec3 place = x1_[static_cast<std::size_t>(contact.point())] + contact.arm;
        footholds_[bodyOf(elements().surfaceOf(contact.point())).island].push_back(
            {place, glm::length(friction), contact.friction * normal, true});
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

// What presses a block presses corners of its cells, which are light: they swing back until the next instant and hardly
// slow the body in the meantime, so that what presses them out again would be energy from nothing.
double ContactStage::longestTurnOf(std::span<const int> surfaces) const {
    constexpr double longestOfBlocks = 1.0;
    const auto isBlock = [&](int s) { return isOfBody(s) && !bodyOf(s).model.cells.empty(); };
    return std::any_of(surfaces.begin(), surfaces.end(), isBlock) ? longestOfBlocks : longestTurn;
}

// How many instants would follow what contact moved in the last one, see turnOf().
int ContactStage::instantsToFollow() const {
    const double wanted = std::ceil(instants_ * turn_ / longestTurnOf(result_.surfaces));
    const int most = instantsFor(result_.surfaces);
    return wanted < most ? static_cast<int>(wanted) : most;
}

// Whether an instant was too long for its result: in a trial any impulse, else a shift that works against stiff
// springs, or a pair that went too deep or had to be slid apart. If no island moves, shorter instants would find the
// same.
bool ContactStage::isTooCoarse(bool isTrial) const {
    if (spec_.instants || !movesAny()) return false;
    if (result_.impulses > 0 && (isTrial || instants_ < fewestFor(result_.surfaces))) return true;
    if (instants_ < instantsToFollow()) return true;
    return instants_ < mostInstantsForSpeed &&
           (result_.deepest > mostClosingOf(result_.surfaces) || result_.slides > 0 || further_ > mostFurther);
}

// One try of the tick. Returns true, early, if it needs more instants. Also ends early on a fault.
bool ContactStage::tryTick(const TickTime& time, std::span<const ColliderMotion> moving, int instants,
                           std::vector<std::optional<Fault>>& faults, bool isTrial) {
    const double h = tickSeconds_ / instants;
    for (int c = 0; c < instants; ++c) {
        // The islands move without contact.
        std::swap(x0_, x1_);
        core::parallelFor(
            static_cast<int>(islands_.size()),
            [&](int k) { return islands_[static_cast<std::size_t>(k)]->callsBack(); },
            [&](int k) {
                const auto own = static_cast<std::size_t>(k);
                faults[own] = islands_[own]->advance(time, moving, c, instants);
            });
        if (std::any_of(faults.begin(), faults.end(), [](const auto& fault) { return fault.has_value(); }))
            return false;

        // Contact at the end of the instant.
        readAll();
        shareBefore_ = static_cast<double>(c) / instants;
        share_ = static_cast<double>(c + 1) / instants;
        colliders_.place(share_, x1_);
        resolveInstant(h);
        settle();
        further_ = wholes_.empty() ? 0.0 : furtherIntoColliders(h);
        if (findFaults(time.at(c + 1, instants), faults)) return false;
        if (!presses_.empty()) addPresses();
        if (!presses_.empty() && !wholes_.empty()) addFootholds();
        if (anySleeps() && findReached()) return true;
        if (isTooCoarse(isTrial)) return true;
    }
    return false;
}

// ω H of the shift by which contact moved the points of an island in the last instant [rad]: ω² is its Rayleigh
// quotient. The springs gain ½ shift·K shift by it, where contact took ½ m (shift/h)² from the motion.
double ContactStage::turnOf(const Part& part, double h) const {
    if (part.island->isStill()) return 0;
    const auto first = static_cast<std::size_t>(part.first), count = static_cast<std::size_t>(part.last) - first;
    std::vector<dvec3> shift(count, dvec3(0.0)), force(count, dvec3(0.0));
    double inertia = 0;
    for (int i : result_.moved) {
        if (i < part.first || i >= part.last) continue;
        const auto k = static_cast<std::size_t>(i);
        const dvec3 way = x1_[k] - xBefore_[k];
        shift[k - first] = way;
        inertia += glm::dot(way, way) / inverseMass_[k];
    }
    if (!(inertia > 0)) return 0;
    part.island->stiffnessAt(std::span(x1_).subspan(first, count))(shift, force);
    double stiffness = 0;
    for (std::size_t k = 0; k < count; ++k) stiffness += glm::dot(shift[k], force[k]);
    return h * std::sqrt(std::max(stiffness, 0.0) / inertia);
}

// Resolves one instant of contact, h [s] after the last.
void ContactStage::resolveInstant(double h) {
    kinematic_.clear();
    for (const Part& part : parts_)
        for (const collision::Contact& c :
             part.island->isStill() ? std::span<const collision::Contact>{} : part.island->contacts())
            kinematic_.push_back({.points = {part.first + c.point, -1, -1},
                                  .normal = c.normal,
                                  .speed = glm::dot(c.normal, c.carried),
                                  .carried = c.carried,
                                  .friction = c.friction});
    if (!wholes_.empty()) addWholeContacts(h);
    findTouches(x0_, x1_, shareBefore_, share_);
    addTouches();
    std::stable_sort(kinematic_.begin(), kinematic_.end(),
                     [](const auto& a, const auto& b) { return a.point() < b.point(); });
    contact::Instant instant;
    instant.h = h;
    instant.x0 = x0_;
    instant.x1 = x1_;
    instant.v = v_;
    instant.inverseMass = inverseMass_;
    instant.kinematic = kinematic_;
    instant.rigid = rigidPairs_;
    instant.deepestTouch = deepestTouch_;
    instant.restSpeed = 2.0 * weight_ * h;  // as with colliders
    // Islands place the points that contact moved and return where these came to be.
    instant.place = [&](std::span<const int> points) {
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
    };

    xBefore_ = x1_;
    vBefore_ = v_;
    const auto start = Clock::now();
    result_ = group_->resolve(instant);
    accelerations_.clear();
    for (const int i : result_.moved)
        accelerations_.push_back((v_[static_cast<std::size_t>(i)] - vBefore_[static_cast<std::size_t>(i)]) / h);
    total_.seconds += secondsSince(start);
    total_.testedPairs += static_cast<std::int64_t>(group_->testedCount());
    hadImpulse_ = hadImpulse_ || result_.impulses > 0;
    turn_ = 0;
    if (result_.impulses > 0 && !spec_.instants && instants_ < instantsFor(result_.surfaces))
        for (const Part& part : parts_) turn_ = std::max(turn_, turnOf(part, h));
    total_.slides += result_.slides;
    total_.zones += result_.zones;
    total_.uncertified += result_.uncertified;
}

// Constraints inside islands share the changes by contact, which moves further points.
void ContactStage::settle() {
    bool hasMoved = false;
    for (const Part& part : parts_) {
        if (!part.island->settle()) continue;
        hasMoved = true;
        const auto first = static_cast<std::size_t>(part.first), count = static_cast<std::size_t>(part.last) - first;
        part.island->read(std::span(x1_).subspan(first, count), std::span(v_).subspan(first, count));
    }
    if (!hasMoved) return;
    group_->carried().follow(x1_, v_);
}

// Whether contact gave a point a place or velocity that is not finite or too fast: a fault of its island.
bool ContactStage::findFaults(double t, std::vector<std::optional<Fault>>& faults) const {
    bool areAny = false;
    for (int i : result_.moved) {
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

// Gives the islands the accelerations by contact in the last instant.
void ContactStage::reportAccelerations() {
    std::vector<ContactAcceleration> accelerations;
    std::size_t next = 0;
    for (const Part& part : parts_) {
        accelerations.clear();
        for (; next < result_.moved.size() && result_.moved[next] < part.last; ++next)
            accelerations.push_back({result_.moved[next] - part.first, accelerations_[next]});
        part.island->bear(accelerations);
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
    info.mostInstants = mostInstants();
    info.lastInstants = instants_;
    info.lastTestedPairs = static_cast<int>(group_->testedCount());
    info.lastImpulses = result_.impulses;
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
