#include "taut/world/private/tick.h"

#include <algorithm>

#include "taut/core/private/hash.h"
#include "taut/island/private/island_report.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/colliders.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/sleep.h"

namespace taut::world {
namespace {

// Returns to the state at the start of the tick.
void undoTick(WorldImpl& w) {
    for (const auto& island : w.islands) island->undoTick();
    w.registry.each<Placement>([](ecs::Entity, Placement& placement) { placement.to = placement.from; });
}

}  // namespace

void closeIslands(WorldImpl& w) {
    if (std::none_of(w.islands.begin(), w.islands.end(), [](const auto& island) { return island->isOpen(); })) return;
    w.threads.run([&] {
        const auto island = [&](int i) -> Island& { return *w.islands[i]; };
        core::parallelFor(
            static_cast<int>(w.islands.size()), [&](int i) { return island(i).callsBack(); },
            [&](int i) { island(i).close(w.now()); });
    });
}

std::optional<Divergence> tickIslands(WorldImpl& w, const std::vector<ColliderMotion>& moving) {
    const TickTime time = w.now();
    makeContactStage(w);
    std::vector<Island*> alone;
    for (const auto& island : w.islands)
        if (!touches(island->plan())) alone.push_back(island.get());
    std::vector<std::optional<Fault>> faults(alone.size());
    std::optional<ContactStage::Outcome> outcome;
    w.threads.run([&] {
        core::parallelFor(
            static_cast<int>(alone.size()), [&](int i) { return alone[i]->callsBack(); },
            [&](int i) {
                const auto k = static_cast<std::size_t>(i);
                faults[k] = alone[k]->tick(time, moving);
            });
        if (!w.contactStage->isEmpty()) outcome = w.contactStage->tick(time, moving, endsRestWindow(w));
    });
    const auto diagnose = [&](Island& island, const Fault& fault) {
        undoTick(w);
        return world::diagnose(island, fault, time);
    };
    for (std::size_t i = 0; i < faults.size(); ++i)
        if (faults[i]) {
            if (alone[i]->plan().solver.onDivergence != OnDivergence::freeze) return diagnose(*alone[i], *faults[i]);
            alone[i]->freeze(*faults[i], time);
        }
    if (outcome) return diagnose(*outcome->island, outcome->fault);
    if (!w.contactStage->isEmpty() && !w.contactStage->isAtRest()) w.contactReport.look(*w.contactStage, time.start());
    return std::nullopt;
}

void updateHash(WorldImpl& w) {
    core::Hash next;
    next.add(w.hash);
    next.add(static_cast<std::uint64_t>(w.tick));
    for (const WorldImpl::Member& member : w.bodies) {
        next.add(member.name);
        Island& island = islandOf(*member.body);
        if (!island.isAsleep()) {
            island.addToHash(*member.body, next);
            continue;
        }
        next.add(static_cast<std::uint64_t>(island.company()));
        next.add(island.hashAsleep(*member.body));
    }
    w.hash = next.value();
}

bool touchesAny(const WorldImpl& w) {
    return std::any_of(
        w.islands.begin(), w.islands.end(), [](const auto& island) { return touches(island->plan()); });
}

void makeContactStage(WorldImpl& w) {
    // The faces that a cut bares are surface from now on, and released points touch again.
    core::Hash ties;
    for (const auto& island : w.islands) {
        const IslandPlan& plan = island->plan();
        if (!touches(plan)) continue;
        for (const Body* body : plan.bodies) ties.add(static_cast<std::uint64_t>(body->damage.goneAround()));
        for (const JointTie& tie : plan.ties) ties.add(std::uint64_t{holds(plan, tie)});
        for (const Grip& grip : plan.grips) {
            if (plan.solids.empty() || !grip.ofCollider || !grip.rigid) continue;
            ties.add(std::string_view(grip.holder));
            for (const int i : grip.points) ties.add(static_cast<std::uint64_t>(i));
        }
    }
    if (w.contactStage && ties.value() == w.contactTies) return;
    w.contactTies = ties.value();
    w.contactStage = std::make_unique<ContactStage>(w.islands, w.spec.contact, w.now(), w.contactPace, w.keptForces,
                                                    [&w] { return touchedColliders(w); });
}

std::vector<BodyCrossing> crossingsOf(WorldImpl& w) {
    makeContactStage(w);
    return crossingsOf(*w.contactStage);
}

}  // namespace taut::world
