#include "taut/world/private/sleep.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "taut/world/private/impl.h"

namespace taut::world {
namespace {

bool mayAnySleep(const WorldImpl& w) {
    return w.spec.solver.sleepError > 0 && !w.keepsSteps;
}

// (islands) The least number of an island to which it is connected by contact.
std::vector<std::size_t> companiesOf(const WorldImpl& w) {
    std::vector<std::size_t> lowest(w.islands.size());
    std::iota(lowest.begin(), lowest.end(), std::size_t{0});
    const auto root = [&](std::size_t k) {
        while (lowest[k] != k) k = lowest[k];
        return k;
    };
    const auto numberOf = [&](const Island* island) {
        const auto isOwn = [&](const auto& other) { return other.get() == island; };
        return static_cast<std::size_t>(std::find_if(w.islands.begin(), w.islands.end(), isOwn) - w.islands.begin());
    };
    if (w.contactStage)
        for (const auto& [a, b] : w.contactStage->pressing()) {
            const std::size_t first = root(numberOf(a)), second = root(numberOf(b));
            lowest[std::max(first, second)] = std::min(first, second);
        }
    for (std::size_t k = 0; k < lowest.size(); ++k) lowest[k] = root(k);
    return lowest;
}

// Whether anything holds it besides other islands: friction between them alone would let all of them go together.
bool isGrounded(const Island& island, std::span<const Island::Foothold> footholds) {
    const auto sticksToCollider = [](const auto& foothold) { return foothold.isOnCollider && foothold.limit > 0; };
    const std::vector<bool> isHeld = heldPointsOf(island.plan());
    const auto contacts = island.contacts();
    return std::find(isHeld.begin(), isHeld.end(), true) != isHeld.end() ||
           std::any_of(contacts.begin(), contacts.end(), [](const auto& contact) { return contact.friction > 0; }) ||
           std::any_of(footholds.begin(), footholds.end(), sticksToCollider);
}

// Islands that press each other fall asleep together if all rest.
void endWindow(WorldImpl& w) {
    const std::size_t count = w.islands.size();
    const std::vector<std::size_t> companies = companiesOf(w);
    std::vector<char> isCalm(count, 1), rests(count, 1), areGrounded(count, 0);
    ContactStage::Footholds footholds;
    if (w.contactStage) footholds = w.contactStage->footholds();
    for (std::size_t k = 0; k < count; ++k) {
        Island& island = *w.islands[k];
        if (isGrounded(island, footholds[&island])) areGrounded[companies[k]] = 1;
        if (!island.isStill() && !island.isCalm()) isCalm[companies[k]] = 0;
        if (!island.isStill() && w.contactStage && w.contactStage->crosses(island)) isCalm[companies[k]] = 0;
    }
    const double seconds = static_cast<double>(restWindow(w.ticksPerSecond)) / w.ticksPerSecond;
    for (std::size_t k = 0; k < count; ++k) {
        Island& island = *w.islands[k];
        const std::size_t company = companies[k];
        if (island.isStill() || isCalm[company] == 0 || rests[company] == 0) continue;
        std::vector<Island::Support> supports;
        if (w.contactStage) supports = w.contactStage->supports(island);
        for (Island::Support& support : supports) support.mayStick = support.mayStick && areGrounded[company] != 0;
        std::vector<Island::Foothold> places;
        if (areGrounded[company] != 0) places = footholds[&island];
        if (!island.rests(w.now().start(), seconds, std::move(supports), places)) rests[company] = 0;
    }
    for (std::size_t k = 0; k < count; ++k) {
        Island& island = *w.islands[k];
        if (island.isStill() || isCalm[companies[k]] == 0) continue;
        if (rests[companies[k]] != 0)
            island.fallAsleep(w.now(),
                              static_cast<std::int64_t>(static_cast<std::size_t>(w.tick) * count + companies[k]));
        else
            island.restInVain();
    }
}

// [m] The space swept by figures in this tick.
std::vector<core::Aabb> figuresOnTheWay(const WorldImpl& w) {
    std::vector<core::Aabb> boxes;
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        if (part.model->figure == nullptr) return;
        const std::vector<dvec3> from = part.model->figure->at(w.now().start(), placement.from).places();
        const std::vector<dvec3> to = part.model->figure->at(w.now().end(), placement.to).places();
        if (from == to) return;
        core::Aabb& box = boxes.emplace_back();
        for (const auto* places : {&from, &to})
            for (const dvec3& x : *places) box.add(x);
    });
    return boxes;
}

bool isNear(const Island& island, const core::Aabb& box) {
    double thickness = 0;
    for (const Body* body : island.plan().bodies)
        if (body->spec->collide) thickness = std::max(thickness, body->spec->thickness);
    if (!(thickness > 0)) return false;
    core::Aabb own;
    for (int i = 0; i < std::ssize(island.plan().points); ++i) own.add(island.position(i));
    return own.overlaps(box, thickness);
}

}  // namespace

void wakeReached(WorldImpl& w, std::span<const ColliderMotion> moving) {
    std::vector<std::int64_t> companies;
    std::optional<std::vector<core::Aabb>> figures;
    for (const auto& island : w.islands) {
        if (!island->isAsleep()) continue;
        if (!figures) figures = figuresOnTheWay(w);
        const bool isReached =
            island->isReachedBy(moving) ||
            std::any_of(figures->begin(), figures->end(), [&](const core::Aabb& box) { return isNear(*island, box); });
        if (isReached || island->isOpen()) companies.push_back(island->company());
    }
    if (companies.empty()) return;
    for (const auto& island : w.islands)
        if (island->isAsleep() && std::count(companies.begin(), companies.end(), island->company()) > 0) island->wake();
}

void wakeAll(WorldImpl& w) {
    for (const auto& island : w.islands)
        if (island->isAsleep()) island->wake();
}

bool endsRestWindow(const WorldImpl& w) {
    return mayAnySleep(w) && (w.tick + 1) % restWindow(w.ticksPerSecond) == 0;
}

void letSleep(WorldImpl& w) {
    if (!mayAnySleep(w)) return;
    const std::int64_t window = restWindow(w.ticksPerSecond), into = w.tick % window;
    for (const auto& island : w.islands)
        if (!island->isStill()) island->watchRest(2 * into == window);
    if (into != 0) return;
    endWindow(w);
    for (const auto& island : w.islands)
        if (!island->isStill()) island->beginRestWindow(w.tick / window);
}

}  // namespace taut::world
