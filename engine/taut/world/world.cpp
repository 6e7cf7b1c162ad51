#include "taut/world/world.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/hash.h"
#include "taut/forces/private/scene_forces.h"
#include "taut/island/private/island_report.h"
#include "taut/world/private/impl.h"
#include "taut/spec/private/motion.h"
#include "taut/spec/targets.h"
#include "taut/spec/ticks.h"
#include "taut/bodies/private/ties.h"
#include "taut/bodies/joints/constraint.h"

namespace taut::world {

World::Impl::Impl(const SceneSpec& scene, const Options& options)
    : spec(scene),
      threads(options.threads),
      keepsSteps(options.keepsSteps),
      added(options.forces),
      start(std::make_unique<const SceneSpec>(scene)) {
    ticksPerFrame = Ticks(spec.run).perFrame;
    ticksPerSecond = Ticks(spec.run).perSecond;
    contactPace = StepFollowing(1, 1.0, static_cast<int>(ticksPerSecond));
    for (const CameraSpec& camera : spec.cameras) {
        const ecs::Entity entity = registry.create();
        registry.add(entity, Identity{"camera", camera.name});
        registry.add(entity, CameraPart{camera});
    }
    for (const ColliderSpec& collider : spec.colliders) addCollider(collider);
    addBodies();
    rebuildColliders();
    updateHash();
}

void World::Impl::addBodies() {
    std::vector<Body> built = buildBodies(spec);
    std::vector<Body*> pointers;
    for (Body& body : built) {
        if (isSpawnedLater(body, spec)) {
            checkUntied(body);
            waiting.push_back(std::make_unique<Body>(std::move(body)));
            continue;
        }
        bodies.push_back(addBody(std::make_unique<Body>(std::move(body))));
        pointers.push_back(bodies.back().body);
    }
    checkForces();
    std::vector<Body*> all = allBodies();
    for (const auto& body : waiting) all.push_back(body.get());
    checkTies(spec, all, [this](const std::string& collider) { return poseOf(collider); });
    const Envelopes envelopes(*start);
    const ForceList current = forces();
    std::vector<JointReport> reports;
    for (IslandPlan& plan : planIslands(pointers, spec, &reports)) addIsland(std::move(plan), current, envelopes, true);
    takeJoints(reports);
}

// A body that comes later cannot be tied to others: islands are made once.
void World::Impl::checkUntied(Body& body) const {
    for (const JointSpec& joint : spec.joints) {
        if (isTie(joint)) continue;
        for (const JointSide& side : {joint.a, joint.b})
            if (names(side, body))
                throw core::Error(core::ErrorKind::badContent,
                                  at(joint.source) + "\"" + side.text() + "\" ties " + body.fullName() +
                                      ", which is spawned later; a spawned body cannot be tied to another");
    }
}

World::Impl::Member World::Impl::addBody(std::unique_ptr<Body> body) {
    const ecs::Entity entity = registry.create();
    registry.add(entity, Identity{std::string(body->kind()), body->name});
    Member member{entity, body.get(), body->fullName()};
    std::unique_ptr<BodyDrawing> drawing = body->spec->drawing(*body);
    registry.add(entity, BodyPart{std::move(body), std::move(drawing)});
    return member;
}

std::vector<Body*> World::Impl::allBodies() const {
    std::vector<Body*> all;
    for (const Member& member : bodies) all.push_back(member.body);
    return all;
}

// Those of the scene as they are now, then those that were added.
ForceList World::Impl::forces() const {
    ForceList all = sceneForces(spec);
    all.insert(all.end(), added.begin(), added.end());
    return all;
}

// That each finds what it acts on, of bodies that are there or wait.
void World::Impl::checkForces() const {
    std::vector<Body*> all = allBodies();
    for (const auto& body : waiting) all.push_back(body.get());
    for (const ForceSpec& force : spec.forces) force.checkBodies(all);
}

void World::Impl::addIsland(IslandPlan plan, const ForceList& current, const Envelopes& envelopes, bool hasJoints) {
    plan.solver.precision = spec.solver.precision;
    addTies(plan, spec, [this](const std::string& collider) { return poseOf(collider); });
    for (const auto& constraint : plan.constraints) constraint->check();
    const std::vector<Body*> members = plan.bodies;
    const Envelope envelope = envelopes.of(plan, current, hasJoints);
    const int parts = touches(plan) ? fewestInstants(1.0 / ticksPerSecond) : 1;
    islands.push_back(
        std::make_unique<Island>(std::move(plan), current, envelope, ticksPerSecond, seconds(), keepsSteps, parts));
    contactStage.reset();
    for (Body* body : members) body->island = islands.back().get();
}

ecs::Entity World::Impl::addCollider(const ColliderSpec& collider) {
    const ecs::Entity entity = registry.create();
    registry.add(entity, Identity{"collider", collider.name});
    const bool mayTurn = anyForeseen<MoveAction>(start->actions, [&](const MoveAction& move) {
        const Target target = parseTarget(move.target);
        return move.rotation && target.kind == "collider" && matches(target.name, collider.name);
    });
    const collision::ShapeKinds& kinds = spec.shapes != nullptr ? *spec.shapes : collision::builtInShapes();
    registry.add(entity, ColliderPart{collider, makeColliderModel(collider, kinds, mayTurn, spec.colliders)});
    const collision::Pose pose = poseAt(collider, seconds());
    registry.add(entity, Placement{pose, pose});
    return entity;
}

collision::Colliders World::Impl::colliders() const {
    collision::Colliders all;
    registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        all.add(part.model->shape, {part.spec.friction, part.spec.restitution}, placement.to);
    });
    return all;
}

void World::Impl::rebuildColliders() {
    const collision::Colliders all = colliders();
    std::vector<std::string> names;
    registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement&) {
        names.push_back("collider." + part.spec.name);
    });
    for (const auto& island : islands) island->setColliders(all.clone(), names);
    contactStage.reset();
}

ecs::Entity World::Impl::spawn(Body body) {
    startBody(body);
    const ecs::Entity entity = addAlone(std::make_unique<Body>(std::move(body)));
    rebuildColliders();
    return entity;
}

// An island of its own.
ecs::Entity World::Impl::addAlone(std::unique_ptr<Body> body) {
    const Member newcomer = addBody(std::move(body));
    const auto place = std::find_if(bodies.begin(), bodies.end(),
                                    [&](const Member& other) { return sortsBefore(*newcomer.body, *other.body); });
    bodies.insert(place, newcomer);
    ++generation;
    SceneSpec alone;  // the joints of the scene do not concern it
    alone.solver = spec.solver;
    const Envelopes envelopes(*start);
    const ForceList current = forces();
    for (IslandPlan& plan : planIslands(std::vector<Body*>{newcomer.body}, alone))
        addIsland(std::move(plan), current, envelopes, false);
    return newcomer.entity;
}

// Where each collider is when the coming tick ends.
void World::Impl::placeColliders() {
    const double end = static_cast<double>(tick + 1) / ticksPerSecond;
    registry.each<Placement>([&](ecs::Entity entity, Placement& placement) {
        placement.from = placement.to;
        const ColliderPart* part = registry.find<ColliderPart>(entity);
        if (part == nullptr) return;
        if (const auto& move = part->move) {
            // Once there it may be moved by others.
            if (tick < move->start + move->length)
                placement.to =
                    between(move->from, move->to,
                            shareOfWay(move->ease, static_cast<double>(tick + 1 - move->start), move->length));
        } else if (!part->spec.keys.empty()) {
            placement.to = poseAt(part->spec, end);
        }
    });
}

// Those that move in this tick, and those that came to rest after the last.
std::vector<ColliderMotion> World::Impl::movingColliders() {
    std::vector<ColliderMotion> moving;
    int number = 0;
    registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart&, Placement& placement) {
        const bool moves =
            placement.from.position != placement.to.position || placement.from.rotation != placement.to.rotation;
        if (moves || placement.moved) moving.push_back({number, placement.from, placement.to});
        placement.moved = moves;
        ++number;
    });
    return moving;
}

void World::Impl::makeContactStage() {
    // What a cut bares is surface from then on.
    std::size_t gone = 0;
    for (const auto& island : islands)
        if (touches(island->plan()))
            for (const Body* body : island->plan().bodies) gone += body->damage.goneAround();
    if (contactStage && gone == goneAround) return;
    goneAround = gone;
    contactStage =
        std::make_unique<ContactStage>(islands, spec.contact, 1.0 / ticksPerSecond, contactPace, [this] { return met(); });
}

// Those that touch go together, all others side by side.
std::optional<Divergence> World::Impl::tickIslands(const std::vector<ColliderMotion>& moving) {
    const TickTime time = now();
    makeContactStage();
    std::vector<Island*> alone;
    for (const auto& island : islands)
        if (!touches(island->plan())) alone.push_back(island.get());
    std::vector<std::optional<Fault>> faults(alone.size());
    std::optional<ContactStage::Outcome> outcome;
    threads.run([&] {
        core::parallelFor(
            static_cast<int>(alone.size()), [&](int i) { return alone[static_cast<std::size_t>(i)]->callsBack(); },
            [&](int i) {
                const auto k = static_cast<std::size_t>(i);
                faults[k] = alone[k]->tick(time, moving);
            });
        if (!contactStage->isEmpty()) outcome = contactStage->tick(time, moving);
    });
    const auto diagnose = [&](Island& island, const Fault& fault) {
        undoTick();
        return world::diagnose(island, fault, time);
    };
    for (std::size_t i = 0; i < faults.size(); ++i)
        if (faults[i]) {
            if (alone[i]->plan().solver.onDivergence != OnDivergence::freeze) return diagnose(*alone[i], *faults[i]);
            alone[i]->freeze(*faults[i], time);
        }
    if (outcome) return diagnose(*outcome->island, outcome->fault);
    if (!contactStage->isEmpty()) contactReport.look(*contactStage, time.start());
    return std::nullopt;
}

// Everything as it was when the tick began.
void World::Impl::undoTick() {
    for (const auto& island : islands) island->undoTick();
    registry.each<Placement>([](ecs::Entity, Placement& placement) { placement.to = placement.from; });
}

void World::Impl::updateHash() {
    core::Hash next;
    next.add(hash);
    next.add(static_cast<std::uint64_t>(tick));
    for (const Member& member : bodies) {
        next.add(member.name);
        islandOf(*member.body).addToHash(*member.body, next);
    }
    hash = next.value();
}

Island& World::Impl::islandOf(const Body& body) const {
    TAUT_EXPECTS(body.island != nullptr);
    return *body.island;
}

World::World(const SceneSpec& spec, const Options& options) : impl_(std::make_unique<Impl>(spec, options)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

double World::tickSeconds() const {
    return 1.0 / impl_->ticksPerSecond;
}
int World::ticksPerFrame() const {
    return impl_->ticksPerFrame;
}
std::int64_t World::tick() const {
    return impl_->tick;
}
double World::time() const {
    return impl_->seconds();
}

// Bodies are drawn anew when more of them has been severed.
void World::Impl::redrawDamage() {
    registry.each<BodyPart>([](ecs::Entity, BodyPart& part) {
        const std::size_t severed = part.body->damage.edges().size();
        if (severed == part.drawnDamage) return;
        part.drawnDamage = severed;
        part.drawing = part.body->spec->drawing(*part.body);
    });
}

std::optional<Divergence> World::advance() {
    Impl& w = *impl_;
    // What acts between two ticks, systems as well as actions; then the islands that it opened start again.
    w.performDue(*this);
    w.changeColliders();
    w.placeColliders();
    for (const System& system : std::vector<System>(w.systems))
        system(*this, static_cast<double>(w.tick + 1) / w.ticksPerSecond, tickSeconds());
    w.changeForces();
    w.changeSprings();
    w.leadHands();
    w.closeIslands();
    const std::vector<ColliderMotion> moving = w.movingColliders();
    if (auto divergence = w.tickIslands(moving)) return divergence;
    ++w.tick;
    w.breakJoints();
    if (std::any_of(w.islands.begin(), w.islands.end(), [](const auto& island) { return island->hasTorn(); }))
        w.redrawDamage();
    w.changePicture();
    w.updateHash();
    return std::nullopt;
}

std::uint64_t World::stateHash() const {
    return impl_->hash;
}

std::vector<IslandInfo> World::islands() const {
    std::vector<IslandInfo> all;
    for (const auto& island : impl_->islands) all.push_back(infoOf(*island, impl_->now()));
    return all;
}

ode::Work World::work() const {
    ode::Work work;
    for (const auto& island : impl_->islands) work += island->work();
    return work;
}

std::vector<FrozenIsland> World::frozen() const {
    std::vector<FrozenIsland> all;
    for (const auto& island : impl_->islands)
        if (const FrozenIsland* frozen = island->frozen()) all.push_back(*frozen);
    return all;
}

ecs::Registry& World::registry() {
    return impl_->registry;
}
void World::addForce(std::shared_ptr<const Force> force) {
    TAUT_EXPECTS(force != nullptr);
    Impl& w = *impl_;
    const std::string kind = force->name().substr(0, force->name().find('.'));
    if (kind == "wind" || kind == "anchor" || kind == "world")
        throw core::Error(core::ErrorKind::usage, force->name() + ": forces of this kind come with the scene");
    for (const auto& other : w.forces())
        if (other->name() == force->name())
            throw core::Error(core::ErrorKind::usage, "there is a force " + force->name() + " already");
    w.added.push_back(std::move(force));
    const ForceList current = w.forces();
    for (const auto& island : w.islands) {
        if (island->frozen() != nullptr) continue;
        island->setForces(w.now(), current);
        island->change(w.now(), Change::points);  // so that its step is held against the limit as it is now
    }
}
void World::addSystem(System system, const std::string& callback) {
    impl_->systems.push_back(std::move(system));
    if (!callback.empty()) impl_->callbackSystems.push_back(callback);
}

ecs::Entity World::spawn(const ColliderSpec& spec) {
    const ecs::Entity entity = impl_->addCollider(spec);
    impl_->rebuildColliders();
    return entity;
}
ecs::Entity World::spawn(const BodySpec& spec) {
    return impl_->spawn(buildBody(spec, impl_->spec));
}

void World::destroy(ecs::Entity entity) {
    Impl& w = *impl_;
    TAUT_EXPECTS(w.registry.isAlive(entity));
    if (const BodyPart* part = w.registry.find<BodyPart>(entity)) {
        const Island* island = &w.islandOf(*part->body);
        TAUT_EXPECTS(island->plan().bodies.size() == 1);
        w.contactStage.reset();
        w.contactReport.forget(*part->body);
        std::erase_if(
            w.islands, [&](const auto& other) { return other.get() == island; });
        std::erase_if(w.bodies, [&](const Impl::Member& member) { return member.entity == entity; });
        ++w.generation;
    }
    const bool wasCollider = w.registry.find<ColliderPart>(entity) != nullptr;
    if (wasCollider) w.letGo(w.registry.find<Identity>(entity)->fullName());
    w.registry.destroy(entity);
    if (wasCollider) w.rebuildColliders();
}

}  // namespace taut::world
