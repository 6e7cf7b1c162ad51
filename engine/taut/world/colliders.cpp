#include "taut/world/private/colliders.h"

#include <algorithm>

#include "taut/bodies/private/ties.h"
#include "taut/spec/private/motion.h"
#include "taut/spec/targets.h"
#include "taut/world/private/impl.h"

namespace taut::world {

ecs::Entity addCollider(WorldImpl& w, const ColliderSpec& collider) {
    const ecs::Entity entity = w.registry.create();
    w.registry.add(entity, Identity{"collider", collider.name});
    const bool mayTurn = anyForeseen<MoveAction>(w.start->actions, [&](const MoveAction& move) {
        const Target target = parseTarget(move.target);
        return move.rotation && target.kind == "collider" && matches(target.name, collider.name);
    });
    const collision::ShapeKinds& kinds = w.spec.shapes != nullptr ? *w.spec.shapes : collision::builtInShapes();
    w.registry.add(entity, ColliderPart{collider, makeColliderModel(collider, kinds, mayTurn, w.spec.colliders)});
    const collision::Pose pose = poseAt(collider, w.seconds());
    w.registry.add(entity, Placement{pose, pose});
    return entity;
}

void meetFigures(const WorldImpl& w, BodySpec& body) {
    const std::vector<ColliderSpec>& all = w.spec.colliders;
    if (body.collide && std::any_of(all.begin(), all.end(), [](const auto& c) { return c.shape == "figure"; }))
        body.meetsFaces = true;
}

void rebuildColliders(WorldImpl& w) {
    collision::Colliders all;
    std::vector<std::string> names;
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        all.add(part.model->shape, {part.spec.friction, part.spec.restitution}, placement.to);
        names.push_back("collider." + part.spec.name);
    });
    for (const auto& island : w.islands) island->setColliders(all.clone(), names);
    w.contactStage.reset();
}

void placeColliders(WorldImpl& w) {
    const double end = static_cast<double>(w.tick + 1) / w.ticksPerSecond;
    w.registry.each<Placement>([&](ecs::Entity entity, Placement& placement) {
        placement.from = placement.to;
        const ColliderPart* part = w.registry.find<ColliderPart>(entity);
        if (part == nullptr) return;
        if (const auto& move = part->move) {
            // After the end other things may move it.
            if (w.tick < move->start + move->length)
                placement.to =
                    between(move->from, move->to,
                            shareOfWay(move->ease, static_cast<double>(w.tick + 1 - move->start), move->length));
        } else if (!part->spec.keys.empty()) {
            placement.to = poseAt(part->spec, end);
        }
    });
}

std::vector<ColliderMotion> movingColliders(WorldImpl& w) {
    std::vector<ColliderMotion> moving;
    int number = 0;
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart&, Placement& placement) {
        const bool moves =
            placement.from.position != placement.to.position || placement.from.rotation != placement.to.rotation;
        if (moves || placement.moved) moving.push_back({number, placement.from, placement.to});
        placement.moved = moves;
        ++number;
    });
    return moving;
}

void carryTied(WorldImpl& w) {
    if (std::none_of(w.islands.begin(), w.islands.end(), [](const auto& island) {
            return !island->plan().grips.empty() || !island->plan().carriers.empty();
        }))
        return;
    w.registry.each<Identity, ColliderPart>([&](ecs::Entity entity, const Identity& identity, const ColliderPart&) {
        const Placement& placement = *w.registry.find<Placement>(entity);
        const mechanics::PosePath path = pathOf(placement.from, placement.to, w.now().start(), w.ticksPerSecond);
        for (const auto& island : w.islands) island->carry(w.now(), identity.fullName(), path);
    });
}

void letGo(WorldImpl& w, const std::string& collider) {
    for (const auto& island : w.islands)
        island->release(w.now(), [&](const JointTie& tie) { return tie.collider == collider; });
    loosen(w, collider, true);
}

std::optional<collision::Pose> poseOf(const WorldImpl& w, const std::string& collider) {
    std::optional<collision::Pose> pose;
    w.registry.each<Identity, ColliderPart>([&](ecs::Entity entity, const Identity& identity, const ColliderPart&) {
        if (!pose && identity.fullName() == collider) pose = w.registry.find<Placement>(entity)->to;
    });
    return pose;
}

std::vector<TouchedCollider> touchedColliders(const WorldImpl& w) {
    std::vector<TouchedCollider> all;
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        all.push_back({"collider." + part.spec.name, collision::outlinesOf(part.model->shape), part.model->figure,
                       part.spec.friction, placement.to});
    });
    return all;
}

}  // namespace taut::world
