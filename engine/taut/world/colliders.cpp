#include "taut/world/private/colliders.h"

#include <algorithm>
#include <set>

#include "taut/plan/private/ties.h"
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
    w.registry.add(
        entity, ColliderPart{collider, makeColliderModel(collider, w.spec.knownShapes(), mayTurn, w.spec.colliders)});
    const collision::Pose pose = poseAt(collider, w.seconds());
    w.registry.add(entity, Placement{pose, pose});
    return entity;
}

void rebuildColliders(WorldImpl& w) {
    collision::Colliders all;
    std::vector<std::string> names;
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        all.add(part.model->shape, {part.spec.friction, part.spec.restitution, part.spec.turnFriction}, placement.to);
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
    w.registry.each<Identity, ColliderPart>(
        [&](ecs::Entity entity, const Identity& identity, const ColliderPart& part) {
            const Placement& placement = *w.registry.find<Placement>(entity);
            const mechanics::PosePath path = pathOf(placement.from, placement.to, w.now().start(), w.ticksPerSecond);
            for (const auto& island : w.islands) island->carry(w.now(), identity.fullName(), path);
            if (part.model->figure == nullptr) return;
            // Its joints and faces.
            const ColliderFigure& figure = *part.model->figure;
            std::set<std::string> holders;
            for (const auto& island : w.islands) {
                for (const Grip& grip : island->plan().grips) holders.insert(grip.holder);
                for (const Carrier& carrier : island->plan().carriers) holders.insert(carrier.collider);
            }
            std::erase_if(holders, [&](const std::string& holder) {
                return holder == identity.fullName() || parseCollider(holder).collider != identity.fullName();
            });
            if (holders.empty()) return;
            const ColliderFigure::Moment from = figure.at(w.now().start(), placement.from);
            const ColliderFigure::Moment to = figure.at(w.now().end(), placement.to);
            for (const std::string& holder : holders) {
                const ColliderTarget target = parseCollider(holder);
                const mechanics::PosePath own =
                    pathOf(from.frameOf(target).value(), to.frameOf(target).value(), w.now().start(), w.ticksPerSecond);
                for (const auto& island : w.islands) island->carry(w.now(), holder, own);
            }
        });
}

void letGo(WorldImpl& w, const std::string& collider) {
    for (const auto& island : w.islands)
        island->release(w.now(), [&](const JointTie& tie) { return parseCollider(tie.collider).collider == collider; });
    loosen(w, collider, true);
}

collision::Pose poseAhead(const Placement& placement, double ticks) {
    const auto& [from, to, moved] = placement;
    if (ticks == 0.0 || (from.position == to.position && from.rotation == to.rotation)) return to;
    const glm::dquat near = glm::dot(from.rotation, to.rotation) < 0.0 ? -from.rotation : from.rotation;
    return {to.position + ticks * (to.position - from.position),
            glm::normalize(to.rotation * (1.0 + ticks) + near * -ticks)};
}

std::optional<collision::Pose> poseOf(const WorldImpl& w, const std::string& holder, double ahead) {
    const ColliderTarget target = parseCollider(holder);
    std::optional<collision::Pose> pose;
    w.registry.each<Identity, ColliderPart>(
        [&](ecs::Entity entity, const Identity& identity, const ColliderPart& part) {
            if (pose || identity.fullName() != target.collider) return;
            pose = poseAhead(*w.registry.find<Placement>(entity), ahead * w.ticksPerSecond);
            if (target.joint.empty() && target.face < 0) return;
            if (part.model->figure != nullptr)
                pose = part.model->figure->at(w.seconds() + ahead, *pose).frameOf(target);
            else
                pose = std::nullopt;
        });
    return pose;
}

Holders holdersOf(const WorldImpl& w) {
    const auto nearest = [&w](const std::string& collider, const dvec3& x) {
        std::string holder = collider;
        w.registry.each<Identity, ColliderPart>(
            [&](ecs::Entity entity, const Identity& identity, const ColliderPart& part) {
                if (part.model->figure == nullptr || identity.fullName() != collider) return;
                const ColliderFigure::Moment now =
                    part.model->figure->at(w.seconds(), w.registry.find<Placement>(entity)->to);
                holder = collider + "#" + std::to_string(now.nearestFace(x));
            });
        return holder;
    };
    return {[&w](const std::string& holder) { return poseOf(w, holder, 0.0); }, nearest};
}

std::vector<TouchedCollider> touchedColliders(const WorldImpl& w) {
    std::vector<TouchedCollider> all;
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        all.push_back({"collider." + part.spec.name,
                       collision::outlinesOf(part.model->shape),
                       part.model->figure,
                       collision::convexOf(part.model->shape),
                       {part.spec.friction, part.spec.restitution, part.spec.turnFriction},
                       placement.to});
    });
    return all;
}

}  // namespace taut::world
