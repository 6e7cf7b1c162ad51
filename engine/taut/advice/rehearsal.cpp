#include "taut/advice/rehearsal.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "taut/advice/mesh_cells.h"
#include "taut/advice/private/encounters.h"
#include "taut/advice/private/pins.h"
#include "taut/advice/private/start_doubts.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/spec/kinds.h"
#include "taut/spec/ticks.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

constexpr double mostPointSteps = 2e7;  // that it plays: about a second
constexpr double mostSeconds = 2;       // of processor time for all that is played

struct Refusal {
    std::int64_t tick = 0;
    core::Finding finding;
    bool isCertain = false;  // holds wherever bodies will be
    bool isWarning = false;  // the run goes on
};

// Whether the action's finds do not depend on where bodies are.
bool isPlaceless(const ActionSpec& action) {
    if (const auto* cut = dynamic_cast<const CutAction*>(&action)) return cut->from.has_value();
    if (const auto* grab = dynamic_cast<const GrabAction*>(&action)) return !grab->near && grab->radius == 0;
    const auto* points = dynamic_cast<const PointsAction*>(&action);
    return points != nullptr ? !points->near : builtInActions().find(action.kind()) != nullptr;
}

// A hand whose grab was refused can neither move nor release. The refusal has been reported.
bool followsFromAnother(const ActionSpec& action, const std::vector<Refusal>& before) {
    const bool isOfHand =
        dynamic_cast<const MoveAction*>(&action) != nullptr || dynamic_cast<const ReleaseAction*>(&action) != nullptr;
    return isOfHand && !before.empty();
}

std::vector<Refusal> refusals(World& world, RehearsedPins& pins) {
    WorldImpl& w = WorldAccess::of(world);
    const Ticks ticks(w.start->run);
    std::vector<Refusal> all;
    for (const ActionSpec& action : w.start->actions) {
        if (ticks.at(action.t) < w.startTick) continue;
        w.tick = ticks.at(action.t);
        if (w.tick >= ticks.last()) break;
        try {
            const std::size_t warned = w.actionWarnings.size();
            action.perform(world);
            pins.look(world);
            if (w.actionWarnings.size() > warned)
                all.push_back({w.tick, w.actionWarnings.back(), w.tick == w.startTick || isPlaceless(action), true});
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::badContent) throw;
            if (!followsFromAnother(action, all))
                all.push_back({w.tick, error.findings().front(), w.tick == w.startTick || isPlaceless(action), false});
        }
    }
    return all;
}

enum class Outcome { refused, fine, unknown };

void warnOfEncounters(const SceneSpec& scene, double end, Rehearsal& rehearsal) {
    constexpr std::size_t most = 8;
    const auto [pairs, posts, seen] = encounters(scene, 1e9, end);
    std::size_t count = 0;
    for (const auto& [a, b] : pairs)
        if (++count <= most)
            rehearsal.warnings.push_back(warningAt({}) + a + " and " + b +
                                         " come into each other's way and pass through each other: give both touch = "
                                         "\"others\", keep them apart, or tie them by a joint");
    if (count > most)
        rehearsal.warnings.push_back(warningAt({}) + std::to_string(count - most) +
                                     " more pairs of bodies come into each other's way");
    count = 0;
    for (const auto& [names, width] : posts)
        if (++count <= most)
            rehearsal.warnings.push_back(
                warningAt({}) +
                fmt::format("{} fits between the points of {}, which alone meet it: give {} collide = \"faces\", or "
                            "cells of at most {:.2g} m",
                            names.second, names.first, names.first, width));
    if (seen > 0 && seen < scene.run.seconds)
        rehearsal.advice.push_back(fmt::format("looked ahead until {:.2g} s for bodies that meet", seen));
}

// Plays up to the end of that tick. `rehearsal` gets the refusal, or the warnings of actions.
Outcome play(const SceneSpec& scene, std::int64_t tick, double end, Rehearsal& rehearsal) {
    if (core::processorSeconds() > end) return Outcome::unknown;
    World world(scene);
    double pointSteps = 0;
    for (const auto& island : WorldAccess::of(world).islands)
        pointSteps += static_cast<double>(island->plan().points.size()) * world.tickSeconds() / island->step();
    if (pointSteps * static_cast<double>(tick + 1) > mostPointSteps) return Outcome::unknown;
    try {
        while (world.tick() <= tick)
            if (core::processorSeconds() > end || world.advance()) return Outcome::unknown;
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::badContent) throw;
        rehearsal.faults = error.findings();
        return Outcome::refused;
    }
    const std::vector<core::Finding>& found = WorldAccess::of(world).actionWarnings;
    rehearsal.warnings.insert(rehearsal.warnings.end(), found.begin(), found.end());
    return Outcome::fine;
}

// Whether nothing drives the bodies once they have started: their energy can only fall.
bool isLeftAlone(const SceneSpec& scene) {
    return scene.forces.empty() && scene.joints.empty() && bodiesTouch(scene) &&
           std::all_of(
               scene.actions.begin(), scene.actions.end(), [](const auto& action) { return action.t == 0; }) &&
           std::all_of(
               scene.colliders.begin(), scene.colliders.end(),
               [&](const ColliderSpec& collider) { return collider.keys.empty() && !scene.isFigure(collider); });
}

// Whether the energy of bodies without outside forces grows by a tenth of their kinetic and elastic energy. Steps near
// the limit of a method are wrong by less. A body that is pushed out of the ground rises by more than its motion gives.
class EnergyWatch {
  public:
    void look(const World& world) {
        const Metrics now = world.metrics();
        energies_.push_back(now.energy());
        most_ = std::max(most_, now.kinetic + now.elastic);
    }
    std::optional<core::Finding> warning() const {
        constexpr double share = 0.1;
        if (energies_.size() < 10) return std::nullopt;
        const auto few = static_cast<std::ptrdiff_t>(energies_.size() / 10);
        const double first = energies_.front(),
                     last = std::accumulate(energies_.end() - few, energies_.end(), 0.0) / static_cast<double>(few);
        const double gain = last - first;
        if (!(gain > share * most_) || gain > most_) return std::nullopt;
        return warningAt({}) +
               fmt::format(
                   "the energy of the bodies grows by {:.2g} J in the first second, though nothing drives them: give "
                   "them damping, less restitution, or smaller steps (safety of [solver])",
                   gain);
    }

  private:
    std::vector<double> energies_;  // [J] (ticks)
    double most_ = 0;               // [J] in motion and springs
};

// Plays the first second. Bodies that start in the picture and are outside after it; energy that comes from nowhere.
void watchFirstSecond(const SceneSpec& scene, double end, Rehearsal& rehearsal) {
    constexpr double mostOf = 0.5;  // of its points, to be in the picture
    const double seconds = std::min(1.0, scene.run.seconds);
    constexpr std::size_t most = 8;
    const bool watchesEnergy = isLeftAlone(scene);
    if (scene.run.startState != nullptr) return;
    if (core::processorSeconds() > end) return;
    World world(scene);
    WorldImpl& w = WorldAccess::of(world);
    const auto shareOf = [&](const Body& body) { return world.shareInPicture(world.points(body.fullName()).x); };
    const auto middleOf = [&](const Body& body) {
        const auto points = world.points(body.fullName());
        return std::accumulate(points.x.begin(), points.x.end(), dvec3(0.0)) / static_cast<double>(points.x.size());
    };
    struct Start {
        const Body* body;
        dvec3 middle;  // [m]
    };
    std::map<std::string, Start> inside;
    for (const Body* body : bodiesOf(w))
        if (shareOf(*body) >= mostOf) inside[body->fullName()] = {body, middleOf(*body)};
    EnergyWatch energy;
    try {
        while (world.time() < seconds) {
            if (core::processorSeconds() > end || world.advance()) return;
            if (watchesEnergy) energy.look(world);
        }
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::badContent) throw;
        return;
    }
    if (const auto warning = energy.warning()) rehearsal.warnings.push_back(*warning);
    std::size_t count = 0;
    for (const Body* body : bodiesOf(w)) {
        const auto before = inside.find(body->fullName());
        if (before == inside.end() || before->second.body != body || shareOf(*body) > 0) continue;
        // The picture of a scene without a camera need not hold bodies that merely fall.
        const double fall = 0.5 * glm::length(scene.world.gravity) * seconds * seconds;
        if (scene.cameras.empty() && !(glm::distance(middleOf(*body), before->second.middle) > fall)) continue;
        if (++count > most) continue;
        rehearsal.warnings.push_back(warningAt(body->spec->source) + body->fullName() +
                                     " leaves the picture in the first second: move the camera, or hold it in place");
    }
}

}  // namespace

bool isTooLarge(const SceneSpec& scene) {
    constexpr double mostPoints = 100'000;
    double points = 0;
    for (const BodySpec& body : scene.bodies) points += body.outline(scene).points;
    return points > mostPoints;
}

Rehearsal rehearse(const SceneSpec& scene) {
    Rehearsal rehearsal;
    const double end = core::processorSeconds() + mostSeconds;
    World world(scene);
    if (core::processorSeconds() > end)
        rehearsal.advice.push_back("building the bodies took all the time there is: looked ahead at nothing");
    else
        warnOfEncounters(scene, end, rehearsal);
    for (core::Finding& doubt : startDoubts(world)) rehearsal.warnings.push_back(std::move(doubt));
    for (core::Finding& doubt : meshCellDoubts(scene)) rehearsal.warnings.push_back(std::move(doubt));
    for (const auto& island : WorldAccess::of(world).islands)
        if (island->fault()) rehearsal.faults.push_back(*island->fault());
    for (const IslandInfo& island : world.islands())
        rehearsal.advice.insert(rehearsal.advice.end(), island.advice.begin(), island.advice.end());
    for (const core::Finding& warning : world.warnings())
        if (std::none_of(rehearsal.faults.begin(), rehearsal.faults.end(), [&](const core::Finding& fault) {
                return fault.text.find(warning.text) != std::string::npos;
            }))
            rehearsal.warnings.push_back(warning);
    std::optional<std::int64_t> lastDoubtful;
    std::vector<core::Finding> certain, doubts;  // warnings
    RehearsedPins pins;
    pins.look(world);
    const std::vector<Refusal> refused = refusals(world, pins);
    rehearsal.warnings.insert(rehearsal.warnings.end(), pins.warnings().begin(), pins.warnings().end());
    for (const Refusal& refusal : refused) {
        if (refusal.isCertain) {
            (refusal.isWarning ? certain : rehearsal.faults).push_back(refusal.finding);
            continue;
        }
        lastDoubtful = refusal.tick;
        doubts.push_back(refusal.finding + " (where it is as the scene starts)");
        doubts.back().severity = core::Severity::warning;
    }
    std::vector<core::Finding>& warnings = rehearsal.warnings;
    const bool mayRun = rehearsal.faults.empty();
    const Outcome outcome = mayRun && lastDoubtful ? play(scene, *lastDoubtful, end, rehearsal) : Outcome::refused;
    if (mayRun) watchFirstSecond(scene, end, rehearsal);
    if (outcome == Outcome::fine) return rehearsal;
    warnings.insert(warnings.end(), certain.begin(), certain.end());
    if (outcome == Outcome::unknown) warnings.insert(warnings.end(), doubts.begin(), doubts.end());
    return rehearsal;
}

}  // namespace taut::world
