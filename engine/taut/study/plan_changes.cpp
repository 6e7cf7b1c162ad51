#include "taut/study/plan_changes.h"

#include <algorithm>

#include "taut/scene/private/by_key.h"
#include "taut/spec/spec.h"
#include "taut/study/one_method.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

using scene::Change;

// The keys that a plan may change.
constexpr std::string_view plannedKeys[] = {"cells",        "segments", "drag_per_s", "damping_time_s", "bend_N",
                                            "bend_N_per_m", "bulk_Pa",  "drag",       "lift",           "integrator",
                                            "dt",           "safety",   "precision"};

// [s] that the island of a body steps by.
double stepOf(const std::vector<world::IslandInfo>& islands, const std::string& body) {
    double step = 1.0;
    for (const world::IslandInfo& island : islands)
        for (const std::string& name : island.bodies)
            if (name == body || name.starts_with(body + ".")) step = std::min(step, island.step);
    return atMost(step);
}

// Bodies that have a say in these get the planned ones.
void addOverrides(const world::SceneSpec& written, const world::SceneSpec& planned,
                  const std::vector<world::IslandInfo>& islands, std::vector<Change>& changes) {
    const auto number = [&](const std::string& key, const std::optional<double>& before, double after) {
        if (before && *before != after) changes.push_back({key, scene::numberText(after)});
    };
    for (const world::BodySpec& body : written.bodies) {
        const std::string key = body.fullName() + ".solver.";
        if (body.solver.integrator && *body.solver.integrator != planned.solver.integrator)
            changes.push_back({key + "integrator", "\"" + planned.solver.integrator + "\""});
        if (body.solver.dt) number(key + "dt", body.solver.dt, stepOf(islands, body.fullName()));
        number(key + "safety", body.solver.safety, planned.solver.safety);
    }
}

}  // namespace

std::vector<Change> planChanges(const world::SceneSpec& written, const world::SceneSpec& planned) {
    std::vector<Change> changes = scene::differences(written, planned, plannedKeys);
    addOverrides(written, planned, world::World(planned, {.threads = 1}).islands(), changes);
    return changes;
}

}  // namespace taut::study
