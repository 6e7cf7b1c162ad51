#include "world/world.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "world/impl.h"
#include "world/motion.h"
#include "world/targets.h"

namespace taut::world {

World::Impl::Impl(const SceneSpec& scene, const Options& options) : spec(scene), threads(options.threads) {
    ticksPerFrame = std::max(1, static_cast<int>(std::ceil(60.0 / spec.run.fps)));
    ticksPerSecond = spec.run.fps * ticksPerFrame;
    const auto add = [&](const char* kind, const std::string& name, auto part) {
        const ecs::Entity entity = registry.create();
        registry.add(entity, Identity{kind, name});
        registry.add(entity, std::move(part));
    };
    for (const CameraSpec& camera : spec.cameras) add("camera", camera.name, CameraPart{camera});
    for (const WindSpec& wind : spec.winds) add("wind", wind.name, WindPart{wind});
    for (const AnchorSpec& anchor : spec.anchors) add("anchor", anchor.name, AnchorPart{anchor});
    for (const ColliderSpec& collider : spec.colliders) addCollider(collider);
    addBodies();
    rebuildColliders();
    updateHash();
}

void World::Impl::addBodies() {
    std::vector<Body> built = buildBodies(spec);
    std::vector<Body*> pointers;
    for (Body& body : built) {
        const ecs::Entity entity = addBody(std::make_unique<Body>(std::move(body)));
        bodies.push_back(entity);
        pointers.push_back(registry.find<BodyPart>(entity)->body.get());
    }
    for (IslandPlan& plan : planIslands(pointers, spec)) addIsland(std::move(plan));
}

ecs::Entity World::Impl::addBody(std::unique_ptr<Body> body) {
    const ecs::Entity entity = registry.create();
    registry.add(entity, Identity{std::string(kindName(body->kind)), body->name});
    std::unique_ptr<BodyDrawing> drawing = makeDrawing(*body);
    registry.add(entity, BodyPart{std::move(body), std::move(drawing)});
    return entity;
}

// The winds and anchors as they are now, resolved to bodies and points.
IslandForces World::Impl::forces() {
    IslandForces forces;
    forces.gravity = spec.world.gravity;
    std::vector<Body*> all;
    registry.each<BodyPart>([&](ecs::Entity, BodyPart& part) { all.push_back(part.body.get()); });
    registry.each<WindPart>([&](ecs::Entity, const WindPart& part) {
        const WindSpec& wind = part.spec;
        if (wind.drag == 0.0 && wind.lift == 0.0) return;  // without force
        WindOn on;
        on.velocity = wind.velocity;
        on.settings.airDensity = spec.world.airDensity;
        on.settings.drag = wind.drag;
        on.settings.lift = wind.lift;
        on.settings.gust = {wind.gustAmplitude, wind.gustPeriod, wind.gustLength, wind.gustSeed};
        const std::vector<std::string> targets = wind.on.empty() ? std::vector<std::string>{"cloth.*"} : wind.on;
        for (const std::string& target : targets)
            for (const Body* body : matchBodies(all, target)) on.bodies.push_back(body);
        forces.winds.push_back(std::move(on));
    });
    registry.each<AnchorPart>([&](ecs::Entity, const AnchorPart& part) {
        const AnchorSpec& anchor = part.spec;
        bool any = false;
        for (const Body* body : matchBodies(all, anchor.target)) {
            AnchorOn on{anchor.at, anchor.stiffness, anchor.damping, body,
                        selectPoints(body->model, parseTarget(anchor.target).selector)};
            any = any || !on.points.empty();
            if (!on.points.empty()) forces.anchors.push_back(std::move(on));
        }
        if (!any && tick == 0)  // later it may have gone with its body
            throw core::Error(core::ExitCode::badContent,
                              at(anchor.source) + "target = \"" + anchor.target + "\" names no point");
    });
    return forces;
}

void World::Impl::addIsland(IslandPlan plan) {
    plan.solver.precision = spec.solver.precision;
    islands.push_back(makeIsland(std::move(plan), forces(), ticksPerSecond, seconds()));
}

ecs::Entity World::Impl::addCollider(const ColliderSpec& collider) {
    const ecs::Entity entity = registry.create();
    registry.add(entity, Identity{"collider", collider.name});
    registry.add(entity, ColliderPart{collider, makeColliderModel(collider)});
    const collision::Pose pose = poseAt(collider, seconds());
    registry.add(entity, Placement{pose, pose});
    return entity;
}

void World::Impl::rebuildColliders() {
    collision::Colliders colliders;
    registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        colliders.add(part.model->shape, part.model->material, placement.to);
    });
    for (const auto& island : islands) island->setColliders(colliders.clone());
}

ecs::Entity World::Impl::spawn(Body body) {
    startBody(body);
    const ecs::Entity entity = addBody(std::make_unique<Body>(std::move(body)));
    Body* added = registry.find<BodyPart>(entity)->body.get();
    SceneSpec alone;  // the joints of the scene do not concern it
    alone.solver = spec.solver;
    for (IslandPlan& plan : planIslands(std::vector<Body*>{added}, alone)) addIsland(std::move(plan));
    const auto place = std::find_if(bodies.begin(), bodies.end(), [&](ecs::Entity other) {
        return sortsBefore(*added, *registry.find<BodyPart>(other)->body);
    });
    bodies.insert(place, entity);
    rebuildColliders();
    return entity;
}

// Where each collider is when the coming tick ends.
void World::Impl::placeColliders() {
    const double end = static_cast<double>(tick + 1) / ticksPerSecond;
    registry.each<Placement>([&](ecs::Entity entity, Placement& placement) {
        placement.from = placement.to;
        const ColliderPart* part = registry.find<ColliderPart>(entity);
        if (part != nullptr && !part->spec.keys.empty()) placement.to = poseAt(part->spec, end);
    });
}

// Those that move in this tick, and those that came to rest after the last.
std::vector<ColliderMotion> World::Impl::movingColliders() {
    std::vector<ColliderMotion> moving;
    int number = 0;
    registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart&, Placement& placement) {
        const bool moves = placement.from.position != placement.to.position ||
                           placement.from.rotation != placement.to.rotation;
        if (moves || placement.moved) moving.push_back({number, placement.from, placement.to});
        placement.moved = moves;
        ++number;
    });
    return moving;
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
    for (ecs::Entity entity : bodies) {
        const Body& body = *registry.find<BodyPart>(entity)->body;
        next.add(body.fullName());
        islandOf(body).addToHash(body, next);
    }
    hash = next.value();
}

Island& World::Impl::islandOf(const Body& body) const {
    for (const auto& island : islands) {
        const std::vector<Body*>& members = island->plan().bodies;
        if (std::find(members.begin(), members.end(), &body) != members.end()) return *island;
    }
    core::failCheck("a body lives in an island", __FILE__, __LINE__);
}

World::World(const SceneSpec& spec, const Options& options) : impl_(std::make_unique<Impl>(spec, options)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

double World::tickSeconds() const { return 1.0 / impl_->ticksPerSecond; }
int World::ticksPerFrame() const { return impl_->ticksPerFrame; }
std::int64_t World::tick() const { return impl_->tick; }
double World::time() const { return impl_->seconds(); }

std::optional<Divergence> World::advance() {
    Impl& w = *impl_;
    const TickTime now = w.now();
    w.placeColliders();
    for (const System& system : std::vector<System>(w.systems))
        system(*this, static_cast<double>(w.tick + 1) / w.ticksPerSecond, tickSeconds());
    const std::vector<ColliderMotion> moving = w.movingColliders();
    std::vector<std::optional<Fault>> faults(w.islands.size());
    w.threads.run([&] {
        core::parallelFor(static_cast<int>(w.islands.size()), [&](int i) {
            const auto k = static_cast<std::size_t>(i);
            faults[k] = w.islands[k]->tick(now, moving);
        });
    });
    for (std::size_t i = 0; i < faults.size(); ++i)
        if (faults[i]) {
            if (w.islands[i]->plan().solver.onDivergence == OnDivergence::freeze) {
                w.islands[i]->freeze(*faults[i], now);
                continue;
            }
            w.undoTick();
            return w.islands[i]->diagnose(*faults[i], now);
        }
    ++w.tick;
    w.updateHash();
    return std::nullopt;
}

std::uint64_t World::stateHash() const { return impl_->hash; }

Metrics World::metrics() const {
    Metrics metrics;
    metrics.time = time();
    for (const auto& island : impl_->islands) island->addMetrics(impl_->now(), metrics);
    return metrics;
}

std::vector<IslandInfo> World::islands() const {
    std::vector<IslandInfo> all;
    for (const auto& island : impl_->islands) all.push_back(island->info());
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

std::vector<std::string> World::warnings() const {
    std::vector<std::string> all;
    for (const auto& island : impl_->islands)
        for (const std::string& warning : island->warnings()) all.push_back(warning);
    return all;
}

ecs::Registry& World::registry() { return impl_->registry; }
void World::addSystem(System system) { impl_->systems.push_back(std::move(system)); }

ecs::Entity World::spawn(const ColliderSpec& spec) {
    const ecs::Entity entity = impl_->addCollider(spec);
    impl_->rebuildColliders();
    return entity;
}
ecs::Entity World::spawn(const ClothSpec& spec) { return impl_->spawn(buildBody(spec, impl_->spec.materials)); }
ecs::Entity World::spawn(const RopeSpec& spec) { return impl_->spawn(buildBody(spec)); }
ecs::Entity World::spawn(const BlockSpec& spec) { return impl_->spawn(buildBody(spec)); }
ecs::Entity World::spawn(const NetSpec& spec) { return impl_->spawn(buildBody(spec)); }

void World::destroy(ecs::Entity entity) {
    Impl& w = *impl_;
    TAUT_EXPECTS(w.registry.isAlive(entity));
    if (const BodyPart* part = w.registry.find<BodyPart>(entity)) {
        const Island* island = &w.islandOf(*part->body);
        TAUT_EXPECTS(island->plan().bodies.size() == 1);
        std::erase_if(w.islands, [&](const auto& other) { return other.get() == island; });
        std::erase(w.bodies, entity);
    }
    const bool wasCollider = w.registry.find<ColliderPart>(entity) != nullptr;
    w.registry.destroy(entity);
    if (wasCollider) w.rebuildColliders();
}

std::vector<glm::dvec3> World::positions(ecs::Entity entity) const {
    const BodyPart* part = impl_->registry.find<BodyPart>(entity);
    TAUT_EXPECTS(part != nullptr);
    const Island& island = impl_->islandOf(*part->body);
    std::vector<glm::dvec3> positions;
    for (int i : part->body->pointOf) positions.push_back(island.position(i));
    return positions;
}

}  // namespace taut::world
