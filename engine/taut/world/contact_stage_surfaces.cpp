// Makes the surfaces, masses and solids for the ContactGroup.
#include "taut/world/private/contact_stage.h"

#include <algorithm>
#include <numeric>

#include "taut/bodies/private/carried_surface.h"
#include "taut/plan/held_pair.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

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
                           const TickTime& now, StepFollowing& pace, std::vector<contact::KeptForce>& kept,
                           const std::function<std::vector<TouchedCollider>()>& colliders)
    : spec_(spec),
      tickSeconds_(1.0 / now.ticksPerSecond),
      fewest_(fewestSteps(tickSeconds_)),
      pace_(pace),
      keptForces_(kept) {
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
    solidOf_.assign(x1_.size(), -1);
    for (std::size_t s = 0; s < solids_.size(); ++s)
        for (const int point : solids_[s]) solidOf_[static_cast<std::size_t>(point)] = static_cast<int>(s);
    keepJoinedApart(offsets, touched, now.start());
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

// Excludes pairs of rigid bodies that a joint holds together, and of bodies and the colliders that carry them: contact
// would work against the joint.
// offsets: (surfaces) of their island's points.
void ContactStage::keepJoinedApart(std::span<const int> offsets, std::span<const TouchedCollider> touched, double t) {
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
        const std::span<const HeldPair> held = part.island->heldPairs(t);
        for (const JointTie& tie : plan.ties) {
            if (!holds(plan, tie)) continue;
            if (tie.touch) addPivot(part, static_cast<std::size_t>(&tie - plan.ties.data()), touched);
            if (tie.touch) continue;
            if (tie.b >= 0) join(part.first + tie.a, part.first + tie.b);
            const auto pins = [&](const HeldPair& pair) { return pair.length == 0 && tie.has(pair.by); };
            if (!tie.collider.empty() && std::any_of(held.begin(), held.end(), pins))
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

// Where sides of a joint touch that hold a solid.
void ContactStage::addPivot(const Part& part, std::size_t tie, std::span<const TouchedCollider> touched) {
    const JointTie& own = part.island->plan().ties[tie];
    const auto solidAt = [&](int point) {
        return point < 0 ? -1 : solidOf_[static_cast<std::size_t>(part.first + point)];
    };
    Pivot pivot{solidAt(own.a), solidAt(own.b), -1, &part, tie, {}, 0};
    for (std::size_t c = 0; c < touched.size() && !own.collider.empty(); ++c)
        if (touched[c].name == parseCollider(own.collider).collider) pivot.collider = static_cast<int>(c);
    if (pivot.solid >= 0 && (pivot.other >= 0 || pivot.collider >= 0)) pivots_.push_back(pivot);
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

// Points of islands that are still have no inverse mass. Marks the surfaces that sleep or have just woken.
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

}  // namespace taut::world
