#include "taut/world/world.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/joints/sewn_panels.h"
#include "taut/spec/ticks.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/cameras.h"
#include "taut/world/private/colliders.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/joints.h"
#include "taut/world/private/saving.h"
#include "taut/world/private/sleep.h"
#include "taut/world/private/tick.h"
#include "taut/world/private/timeline.h"

namespace taut::world {
namespace {

SceneSpec completed(SceneSpec scene) {
    meetFigures(scene);
    evenSeams(scene);
    scene.world.sealedPressure = scene.world.airPressure;
    return scene;
}

}  // namespace

WorldImpl::WorldImpl(const SceneSpec& scene, const Options& options)
    : spec(completed(scene)),
      start(std::make_unique<const SceneSpec>(spec)),
      threadCount(options.threads),
      threads(options.threads),
      keepsSteps(options.keepsSteps),
      added(options.forces) {
    ticksPerFrame = Ticks(spec.run).perFrame;
    ticksPerSecond = Ticks(spec.run).perSecond;
    contactPace = StepFollowing(1, 1.0, static_cast<int>(ticksPerSecond));
    for (const CameraSpec& camera : spec.cameras) {
        const ecs::Entity entity = registry.create();
        registry.add(entity, Identity{"camera", camera.name});
        registry.add(entity, CameraPart{camera});
    }
    for (const ColliderSpec& collider : spec.colliders) addCollider(*this, collider);
    if (spec.picture.smooth)
        for (BodySpec& body : spec.bodies) body.finish.smooth = *spec.picture.smooth;
    addBodies(*this);
    rebuildColliders(*this);
    followBodies(*this);
    updateHash(*this);
}

WorldImpl& WorldAccess::of(World& world) {
    return *world.impl_;
}

World::World(const SceneSpec& spec, const Options& options) : impl_(std::make_unique<WorldImpl>(spec, options)) {
    const StartState* kept = spec.run.startState.get();
    if (kept == nullptr) return;
    try {
        restore(kept->bytes);
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), at(spec.run.startSource) + "cannot start from " + spec.run.start + ": " +
                                            error.what() +
                                            "; keep a state of this scene's bodies, joints and colliders");
    }
    impl_->startTick = impl_->tick;
}
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
std::int64_t World::startTick() const {
    return impl_->startTick;
}
double World::time() const {
    return impl_->seconds();
}

std::optional<Divergence> World::advance() {
    WorldImpl& w = *impl_;
    // Performs actions and systems between two ticks. Then the islands that they opened start again.
    performDue(*this);
    changeColliders(w);
    placeColliders(w);
    for (const System& system : std::vector<System>(w.systems))
        system(*this, static_cast<double>(w.tick + 1) / w.ticksPerSecond, tickSeconds());
    changeForces(w);
    changeSprings(w);
    leadHands(w);
    carryTied(w);
    beginJoints(w);
    const std::vector<ColliderMotion> moving = movingColliders(w);
    wakeReached(w, moving);
    closeIslands(w);
    if (auto divergence = tickIslands(w, moving)) return divergence;
    ++w.tick;
    breakJoints(w);
    if (std::any_of(w.islands.begin(), w.islands.end(), [](const auto& island) { return island->hasTorn(); }))
        redrawDamage(w);
    changePicture(w);
    followBodies(w);
    letSleep(w);
    updateHash(w);
    return std::nullopt;
}

ecs::Registry& World::registry() {
    return impl_->registry;
}

const ecs::Registry& World::registry() const {
    return impl_->registry;
}
void World::addForce(std::shared_ptr<const Force> force) {
    TAUT_EXPECTS(force != nullptr);
    WorldImpl& w = *impl_;
    const std::string kind = force->name().substr(0, force->name().find('.'));
    if (kind == "wind" || kind == "anchor" || kind == "world")
        throw core::Error(core::ErrorKind::usage, force->name() + ": forces of this kind come with the scene");
    for (const auto& other : forcesOf(w))
        if (other->name() == force->name())
            throw core::Error(core::ErrorKind::usage, "there is a force " + force->name() + " already");
    w.added.push_back(std::move(force));
    const ForceList current = forcesOf(w);
    for (const auto& island : w.islands) {
        if (island->frozen() != nullptr) continue;
        island->setForces(w.now(), current);
        island->change(w.now(), Change::points);  // so that its step is checked against the present limit
    }
}
void World::addSystem(System system, const std::string& callback) {
    impl_->systems.push_back(std::move(system));
    if (!callback.empty()) impl_->callbackSystems.push_back(callback);
}

ecs::Entity World::spawn(const ColliderSpec& spec) {
    wakeAll(*impl_);
    const ecs::Entity entity = addCollider(*impl_, spec);
    rebuildColliders(*impl_);
    return entity;
}
ecs::Entity World::spawn(const BodySpec& spec) {
    return world::spawn(*impl_, buildBody(spec, impl_->spec));
}

void World::destroy(ecs::Entity entity) {
    WorldImpl& w = *impl_;
    TAUT_EXPECTS(w.registry.isAlive(entity));
    if (w.registry.find<BodyPart>(entity) != nullptr || w.registry.find<ColliderPart>(entity) != nullptr) wakeAll(w);
    if (w.registry.find<BodyPart>(entity) != nullptr) removeBody(w, entity);
    const bool wasCollider = w.registry.find<ColliderPart>(entity) != nullptr;
    if (wasCollider) letGo(w, w.registry.find<Identity>(entity)->fullName());
    w.registry.destroy(entity);
    if (wasCollider) rebuildColliders(w);
}

void World::apply(const ActionSpec& action) {
    action.perform(*this);
}

std::vector<std::byte> World::save() const {
    core::ByteWriter writer;
    StateBytes bytes(writer);
    visit(*impl_, bytes);
    return writer.take();
}

void World::restore(std::span<const std::byte> content, std::span<const RampAction> applied) {
    TAUT_EXPECTS(impl_->tick == impl_->startTick);
    if (impl_->tick > 0) {  // bytes are read into a world that has not begun
        WorldImpl& old = *impl_;
        auto fresh = std::make_unique<WorldImpl>(
            *old.start, Options{.threads = old.threadCount, .forces = old.added, .keepsSteps = old.keepsSteps});
        fresh->systems = std::move(old.systems);
        fresh->callbackSystems = std::move(old.callbackSystems);
        fresh->startTick = old.startTick;
        impl_ = std::move(fresh);
    }
    core::ByteReader reader(content);
    StateBytes bytes(reader);
    visit(*impl_, bytes, applied);
    if (!reader.isAtEnd()) misfit("there is more in them than it has");
    rebuildColliders(*impl_);
    redrawDamage(*impl_);
    impl_->contactStage.reset();
}

}  // namespace taut::world
