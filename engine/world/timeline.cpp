// The actions of a scene, each done at the start of its tick.
#include <algorithm>

#include "taut/core/error.h"
#include "taut/world/cutting.h"
#include "taut/world/impl.h"
#include "taut/world/motion.h"
#include "taut/world/rotation.h"
#include "taut/world/targets.h"
#include "taut/world/ticks.h"

namespace taut::world {
namespace {

double distance2(const dvec3& a, const dvec3& b) {
    return glm::dot(b - a, b - a);
}

}  // namespace

void failAction(const ActionSpec& action, const std::string& message) {
    throw core::Error(core::ExitCode::badContent, at(action.source) + message);
}

std::vector<std::pair<Island*, std::vector<int>>> byIsland(const std::vector<Picked>& points) {
    std::vector<std::pair<Island*, std::vector<int>>> lists;
    for (const Picked& p : points) {
        if (p.island->frozen() != nullptr) continue;
        if (lists.empty() || lists.back().first != p.island) lists.push_back({p.island, {}});
        lists.back().second.push_back(p.point);
    }
    return lists;
}

void World::Impl::performDue() {
    const Ticks ticks(start->run);
    for (const ActionSpec& action : start->actions)
        if (ticks.at(action.t) == tick) perform(action);
}

void World::Impl::perform(const ActionSpec& action) {
    switch (action.what) {
        case Do::grab:
            return grab(action);
        case Do::move:
            return action.target.empty() ? moveHand(action) : moveCollider(action);
        case Do::release:
            return release(action);
        case Do::push:
            return push(action);
        case Do::hold:
            return hold(action);
        case Do::free:
            return free(action);
        case Do::cut:
            return cut(action);
        case Do::addMass:
            return addMass(action);
        case Do::ramp:
            return startRamp(action);
        case Do::spawn:
            return spawnNamed(action);
    }
}

std::vector<Picked> World::Impl::pick(const ActionSpec& action) const {
    std::vector<Picked> points;
    const std::string selector = parseTarget(action.target).selector;
    const std::vector<Body*> all = allBodies();
    for (const Body* body : matchBodies(all, action.target))
        for (int i : selectPoints(body->model, selector))
            points.push_back({&islandOf(*body), body, body->pointOf[static_cast<std::size_t>(i)]});
    if (points.empty()) failAction(action, "target = \"" + action.target + "\" names no point");
    const auto place = [&](const Picked& p) { return p.island->position(p.point); };
    if (action.near) {
        const Picked nearest = *std::min_element(points.begin(), points.end(), [&](const Picked& a, const Picked& b) {
            return distance2(place(a), *action.near) < distance2(place(b), *action.near);
        });
        points = {nearest};
    }
    const auto number = [&](const Picked& p) {
        return std::find_if(islands.begin(), islands.end(), [&](const auto& i) { return i.get() == p.island; });
    };
    std::stable_sort(points.begin(), points.end(), [&](const Picked& a, const Picked& b) {
        return a.island != b.island ? number(a) < number(b) : a.point < b.point;
    });
    const auto same = [](const Picked& a, const Picked& b) { return a.island == b.island && a.point == b.point; };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    return points;
}

// The impulse goes to the points that can move, in proportion to their masses.
void World::Impl::push(const ActionSpec& action) {
    std::vector<Picked> points = pick(action);
    const auto mass = [](const Picked& p) { return p.island->plan().points[static_cast<std::size_t>(p.point)]; };
    std::erase_if(points, [](const Picked& p) { return !isFree(p.island->plan(), p.point); });
    if (points.empty()) failAction(action, "every point of \"" + action.target + "\" is held");
    double sum = 0;
    for (const Picked& p : points) sum += mass(p).mass;
    for (const auto& [island, numbers] : byIsland(points)) island->push(now(), numbers, action.impulse / sum);
}

void World::Impl::hold(const ActionSpec& action) {
    for (const auto& [island, numbers] : byIsland(pick(action))) {
        IslandPlan& plan = island->change(now(), Change::points);
        for (int i : numbers) plan.points[static_cast<std::size_t>(i)].held = true;
        island->stop(now(), numbers);
    }
}

void World::Impl::free(const ActionSpec& action) {
    for (const auto& [island, numbers] : byIsland(pick(action))) {
        IslandPlan& plan = island->change(now(), Change::points);
        for (int i : numbers) plan.points[static_cast<std::size_t>(i)].held = false;
    }
}

// The points keep their velocities.
void World::Impl::addMass(const ActionSpec& action) {
    const std::vector<Picked> points = pick(action);
    for (const auto& [island, numbers] : byIsland(points)) {
        IslandPlan& plan = island->change(now(), Change::points);
        for (int i : numbers) {
            double& mass = plan.points[static_cast<std::size_t>(i)].mass;
            mass += action.mass / static_cast<double>(points.size());
            if (!(mass > 0)) failAction(action, "this leaves a point of \"" + action.target + "\" without any mass");
        }
    }
}

void World::Impl::cut(const ActionSpec& action) {
    const std::vector<Body*> all = allBodies();
    const std::vector<Body*> bodiesCut = matchBodies(all, action.target);
    if (bodiesCut.empty()) failAction(action, "target = \"" + action.target + "\" names no body");
    bool any = false, isFrozen = false;
    for (const auto& island : islands) {
        const Crossing crossing = crossingOf(action, *island, bodiesCut);
        if (crossing.isEmpty()) continue;
        any = true;
        isFrozen = island->frozen() != nullptr;
        if (!isFrozen) sever(crossing, island->change(now(), Change::shape));
    }
    if (!any) failAction(action, "there is nothing of \"" + action.target + "\" where this cuts");
    redrawDamage();
}

// Bodies wait from the start, built; an island of each begins now.
void World::Impl::spawnNamed(const ActionSpec& action) {
    const Target target = parseTarget(action.target);
    bool any = false;
    for (auto& body : waiting) {
        if (target.kind != body->kind()) continue;
        if (!matches(target.name, body->name) && !matches(target.name, body->base())) continue;
        any = true;
        takeSprings(*body);
        addAlone(std::move(body));
        body = nullptr;
    }
    if (!any) failAction(action, "no body \"" + action.target + "\" waits to be spawned");
    std::erase(waiting, nullptr);
    spawned.push_back(action.target);
    // Winds and anchors that were without it may act on it.
    const ForceList current = forces();
    for (const auto& island : islands) island->setForces(now(), current);
    rebuildColliders();
}

void World::Impl::moveCollider(const ActionSpec& action) {
    bool any = false;
    registry.each<Identity, ColliderPart>([&](ecs::Entity entity, const Identity& identity, ColliderPart& part) {
        const Target target = parseTarget(action.target);
        if (target.kind != identity.kind || !matches(target.name, identity.name)) return;
        any = true;
        const collision::Pose from = registry.find<Placement>(entity)->to;
        collision::Pose to = from;
        if (action.to) to.position = *action.to;
        if (action.rotation) to.rotation = rotationOf(*action.rotation);
        part.move = PoseMove{from, to, tick, ticksIn(action.over, ticksPerSecond), action.ease};
    });
    if (!any) failAction(action, "there is no collider \"" + action.target + "\" to move");
}

void World::Impl::closeIslands() {
    if (std::none_of(islands.begin(), islands.end(), [](const auto& island) { return island->isOpen(); })) return;
    threads.run([&] {
        core::parallelFor(static_cast<int>(islands.size()),
                          [&](int i) { islands[static_cast<std::size_t>(i)]->close(now()); });
    });
}

void World::apply(const ActionSpec& action) {
    impl_->perform(action);
}

}  // namespace taut::world
