#include "taut/world/private/timeline.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/spec/targets.h"
#include "taut/spec/ticks.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"

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
    return point.island->plan().points[point.point].mass;
}

void performDue(World& world) {
    const WorldImpl& w = WorldAccess::of(world);
    const Ticks ticks(w.start->run);
    for (const ActionSpec& action : w.start->actions)
        if (ticks.at(action.t) <= w.tick && w.tick <= ticks.at(action.t + action.lasts())) action.perform(world);
}

std::vector<Picked> pick(const WorldImpl& w, const PointsAction& action) {
    std::vector<Picked> points;
    const std::string selector = parseTarget(action.target).selector;
    for (const Body* body : matchBodies(bodiesOf(w), action.target))
        for (int i : selectPoints(body->model, selector)) points.push_back({&islandOf(*body), body, body->pointOf[i]});
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
            w.islands.begin(), w.islands.end(), [&](const auto& i) { return i.get() == p.island; });
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

}  // namespace taut::world
