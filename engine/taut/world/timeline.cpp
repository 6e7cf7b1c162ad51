// The actions of a scene when they are due, and what they have in common.
#include <algorithm>

#include "taut/core/error.h"
#include "taut/world/private/impl.h"
#include "taut/spec/targets.h"
#include "taut/spec/ticks.h"

namespace taut::world {
namespace {

double distance2(const dvec3& a, const dvec3& b) {
    return glm::dot(b - a, b - a);
}

}  // namespace

void failAction(const ActionSpec& action, const std::string& message) {
    throw core::Error(core::ErrorKind::badContent, at(action.source) + message);
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

double massOf(const Picked& point) {
    return point.island->plan().points[static_cast<std::size_t>(point.point)].mass;
}

void World::Impl::performDue(World& world) {
    const Ticks ticks(start->run);
    for (const ActionSpec& action : start->actions)
        if (ticks.at(action.t) <= tick && tick <= ticks.at(action.t + action.lasts())) action.perform(world);
}

std::vector<Picked> World::Impl::pick(const PointsAction& action) const {
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
        return std::find_if(
            islands.begin(), islands.end(), [&](const auto& i) { return i.get() == p.island; });
    };
    std::stable_sort(
        points.begin(), points.end(),
        [&](const Picked& a, const Picked& b) {
            return a.island != b.island ? number(a) < number(b) : a.point < b.point;
        });
    const auto same = [](const Picked& a, const Picked& b) { return a.island == b.island && a.point == b.point; };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    return points;
}

// Bodies wait from the start, built; an island of each begins now.
bool World::Impl::spawnWaiting(const std::string& names) {
    const Target target = parseTarget(names);
    bool any = false;
    for (auto& body : waiting) {
        if (target.kind != body->kind()) continue;
        if (!matches(target.name, body->name) && !matches(target.name, body->base())) continue;
        any = true;
        takeSprings(*body);
        addAlone(std::move(body));
        body = nullptr;
    }
    if (!any) return false;
    std::erase(waiting, nullptr);
    spawned.push_back(names);
    // Winds and anchors that were without it may act on it.
    const ForceList current = forces();
    for (const auto& island : islands) island->setForces(now(), current);
    rebuildColliders();
    return true;
}

void World::Impl::closeIslands() {
    if (std::none_of(islands.begin(), islands.end(), [](const auto& island) { return island->isOpen(); })) return;
    threads.run([&] {
        core::parallelFor(
            static_cast<int>(islands.size()), [&](int i) { return islands[static_cast<std::size_t>(i)]->callsBack(); },
            [&](int i) { islands[static_cast<std::size_t>(i)]->close(now()); });
    });
}

void World::apply(const ActionSpec& action) {
    action.perform(*this);
}

}  // namespace taut::world
