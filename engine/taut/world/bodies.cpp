#include "taut/world/private/bodies.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/forces/private/scene_forces.h"
#include "taut/plan/constraint.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/targets.h"
#include "taut/world/private/colliders.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/joints.h"

namespace taut::world {
namespace {

// Throws if a joint ties a body that comes later: islands are made once.
void checkUntied(const WorldImpl& w, Body& body) {
    for (const JointSpec& joint : w.spec.joints) {
        if (isTie(joint)) continue;
        for (const JointSide& side : {joint.a, joint.b})
            if (names(side, body))
                throw core::Error(core::ErrorKind::badContent,
                                  at(joint.source) + "\"" + side.text() + "\" ties " + body.fullName() +
                                      ", which is spawned later; a spawned body cannot be tied to another");
    }
}

WorldImpl::Member addBody(WorldImpl& w, std::unique_ptr<Body> body) {
    const ecs::Entity entity = w.registry.create();
    w.registry.add(entity, Identity{std::string(body->kind()), body->name});
    WorldImpl::Member member{entity, body.get(), body->fullName()};
    std::unique_ptr<BodyDrawing> drawing = body->spec->drawing(*body);
    w.registry.add(entity, BodyPart{std::move(body), std::move(drawing)});
    return member;
}

void addIsland(WorldImpl& w, IslandPlan plan, const ForceList& current, const Envelopes& envelopes, bool hasJoints) {
    plan.solver.precision = w.spec.solver.precision;
    addTies(plan, w.spec, holdersOf(w));
    for (const auto& constraint : plan.constraints) constraint->check();
    expectClosable(plan, w.spec, holdersOf(w));
    const std::vector<Body*> members = plan.bodies;
    const Envelope envelope = envelopes.of(plan, current, hasJoints);
    const int parts = touches(plan) ? fewestSteps(1.0 / w.ticksPerSecond) : 1;
    w.islands.push_back(std::make_unique<Island>(std::move(plan), current, envelope, w.ticksPerSecond, w.seconds(),
                                                 w.keepsSteps, parts));
    w.contactStage.reset();
    w.keptForces.clear();  // contacts get other keys
    for (Body* body : members) body->island = w.islands.back().get();
}

// Adds a body in an island of its own.
ecs::Entity addAlone(WorldImpl& w, std::unique_ptr<Body> body) {
    const WorldImpl::Member newcomer = addBody(w, std::move(body));
    const auto isAfter = [&](const WorldImpl::Member& other) { return sortsBefore(*newcomer.body, *other.body); };
    w.bodies.insert(std::find_if(w.bodies.begin(), w.bodies.end(), isAfter), newcomer);
    ++w.generation;
    SceneSpec alone;  // joints of the scene do not concern it
    alone.solver = w.spec.solver;
    const Envelopes envelopes(*w.start);
    const ForceList current = forcesOf(w);
    for (IslandPlan& plan : planIslands(std::vector<Body*>{newcomer.body}, alone))
        addIsland(w, std::move(plan), current, envelopes, false);
    return newcomer.entity;
}

}  // namespace

void addBodies(WorldImpl& w) {
    std::vector<Body> built = buildBodies(w.spec);
    std::vector<Body*> pointers;
    for (Body& body : built) {
        if (isSpawnedLater(body, w.spec)) {
            checkUntied(w, body);
            w.waiting.push_back(std::make_unique<Body>(std::move(body)));
            continue;
        }
        w.bodies.push_back(addBody(w, std::make_unique<Body>(std::move(body))));
        pointers.push_back(w.bodies.back().body);
    }
    std::vector<Body*> all = bodiesOf(w);
    for (const auto& body : w.waiting) all.push_back(body.get());
    for (const ForceSpec& force : w.spec.forces) force.checkBodies(all);
    checkTies(w.spec, all, holdersOf(w));
    const Envelopes envelopes(*w.start);
    const ForceList current = forcesOf(w);
    std::vector<JointReport> reports;
    for (IslandPlan& plan : planIslands(pointers, w.spec, &reports))
        addIsland(w, std::move(plan), current, envelopes, true);
    takeJoints(w, reports);
}

ecs::Entity spawn(WorldImpl& w, Body body) {
    startBody(body);
    const ecs::Entity entity = addAlone(w, std::make_unique<Body>(std::move(body)));
    rebuildColliders(w);
    return entity;
}

// Waiting bodies were built at the start. Each gets an island now.
bool spawnWaiting(WorldImpl& w, const std::string& names) {
    const Target target = parseTarget(names);
    bool any = false;
    for (auto& body : w.waiting) {
        if (target.kind != body->kind()) continue;
        if (!matches(target.name, body->name) && !matches(target.name, body->base())) continue;
        any = true;
        takeSprings(w.spec, *body);
        addAlone(w, std::move(body));
        body = nullptr;
    }
    if (!any) return false;
    std::erase(w.waiting, nullptr);
    w.spawned.push_back(names);
    // Winds and anchors may act on it that found nothing before.
    const ForceList current = forcesOf(w);
    for (const auto& island : w.islands) island->setForces(w.now(), current);
    rebuildColliders(w);
    return true;
}

void removeBody(WorldImpl& w, ecs::Entity entity) {
    const Body& body = *w.registry.find<BodyPart>(entity)->body;
    const Island* island = &islandOf(body);
    TAUT_EXPECTS(island->plan().bodies.size() == 1);
    w.contactStage.reset();
    w.keptForces.clear();  // contacts get other keys
    w.contactReport.forget(body);
    std::erase_if(
        w.islands, [&](const auto& other) { return other.get() == island; });
    std::erase_if(w.bodies, [&](const WorldImpl::Member& member) { return member.entity == entity; });
    ++w.generation;
}

std::vector<Body*> bodiesOf(const WorldImpl& w) {
    std::vector<Body*> all;
    for (const WorldImpl::Member& member : w.bodies) all.push_back(member.body);
    return all;
}

Island& islandOf(const Body& body) {
    TAUT_EXPECTS(body.island != nullptr);
    return *body.island;
}

void redrawDamage(WorldImpl& w) {
    w.registry.each<BodyPart>([](ecs::Entity, BodyPart& part) {
        const std::size_t severed = part.body->damage.edges().size();
        if (severed == part.drawnDamage) return;
        part.drawnDamage = severed;
        part.drawing = part.body->spec->drawing(*part.body);
    });
}

ForceList forcesOf(const WorldImpl& w) {
    ForceList all = sceneForces(w.spec);
    all.insert(all.end(), w.added.begin(), w.added.end());
    return all;
}

}  // namespace taut::world
