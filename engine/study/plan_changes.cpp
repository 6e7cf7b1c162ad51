#include "taut/study/plan_changes.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/study/one_method.h"
#include "taut/world/each_body.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

using scene::Change;

// As TOML: a number with a point.
std::string numberText(double value) {
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

template <class Vector>
std::string listText(const Vector& values, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += (i > 0 ? ", " : "[") + std::to_string(values[i]);
    return text + "]";
}

class Differences {
  public:
    void number(const std::string& key, double before, double after) {
        if (before != after) changes.push_back({key, numberText(after)});
    }
    void text(const std::string& key, const std::string& before, const std::string& after) {
        if (before != after) changes.push_back({key, "\"" + after + "\""});
    }
    std::vector<Change> changes;
};

void compareBodies(const world::SceneSpec& written, const world::SceneSpec& planned, Differences& all) {
    for (std::size_t i = 0; i < written.cloths.size(); ++i)
        if (written.cloths[i].cells != planned.cloths[i].cells)
            all.changes.push_back({"cloth." + written.cloths[i].name + ".cells", listText(planned.cloths[i].cells, 2)});
    for (std::size_t i = 0; i < written.ropes.size(); ++i) {
        const world::RopeSpec &before = written.ropes[i], &after = planned.ropes[i];
        const std::string key = "rope." + before.name;
        if (before.segments != after.segments)
            all.changes.push_back({key + ".segments", std::to_string(after.segments)});
        all.number(key + ".drag_per_s", before.drag, after.drag);
        all.number(key + ".damping_time_s", before.dampingTime, after.dampingTime);
        all.number(key + ".bend_N", before.bend, after.bend);
    }
    for (std::size_t i = 0; i < written.blocks.size(); ++i) {
        const world::BlockSpec &before = written.blocks[i], &after = planned.blocks[i];
        const std::string key = "block." + before.name;
        if (before.cells != after.cells) all.changes.push_back({key + ".cells", listText(after.cells, 3)});
        all.number(key + ".drag_per_s", before.drag, after.drag);
        all.number(key + ".damping_time_s", before.dampingTime, after.dampingTime);
        all.number(key + ".bulk_Pa", before.bulk, after.bulk);
    }
    for (std::size_t i = 0; i < written.nets.size(); ++i) {
        const world::NetSpec &before = written.nets[i], &after = planned.nets[i];
        const std::string key = "net." + before.name;
        all.number(key + ".drag_per_s", before.drag, after.drag);
        all.number(key + ".damping_time_s", before.dampingTime, after.dampingTime);
        for (std::size_t s = 0; s < before.springs.size(); ++s)
            all.number(fmt::format("{}.springs.{}.damping_time_s", key, s), before.springs[s].dampingTime.value_or(0.0),
                       after.springs[s].dampingTime.value_or(0.0));
    }
}

void compareForces(const world::SceneSpec& written, const world::SceneSpec& planned, Differences& all) {
    for (const auto& [name, before] : written.materials) {
        const world::MaterialSpec& after = planned.materials.at(name);
        const std::string key = "material." + name;
        all.number(key + ".drag_per_s", before.drag, after.drag);
        all.number(key + ".damping_time_s", before.dampingTime, after.dampingTime);
        all.number(key + ".bend_N_per_m", before.bend, after.bend);
    }
    for (std::size_t i = 0; i < written.winds.size(); ++i) {
        const std::string key = "wind." + written.winds[i].name;
        all.number(key + ".drag", written.winds[i].drag, planned.winds[i].drag);
        all.number(key + ".lift", written.winds[i].lift, planned.winds[i].lift);
    }
}

// [s] that the island of a body steps by.
double stepOf(const std::vector<world::IslandInfo>& islands, const std::string& body) {
    double step = 1.0;
    for (const world::IslandInfo& island : islands)
        for (const std::string& name : island.bodies)
            if (name == body || name.starts_with(body + ".")) step = std::min(step, island.step);
    return atMost(step);
}

void compareOverrides(const world::SceneSpec& written, const world::SceneSpec& planned,
                      const std::vector<world::IslandInfo>& islands, Differences& all) {
    forEachBody(written, [&](const std::string& kind, const world::BodySpec& body) {
        const std::string name = kind + "." + body.name, key = name + ".solver.";
        if (body.solver.integrator) all.text(key + "integrator", *body.solver.integrator, planned.solver.integrator);
        if (body.solver.dt) all.number(key + "dt", *body.solver.dt, stepOf(islands, name));
        if (body.solver.safety) all.number(key + "safety", *body.solver.safety, planned.solver.safety);
    });
}

}  // namespace

std::vector<Change> planChanges(const world::SceneSpec& written, const world::SceneSpec& planned) {
    Differences all;
    compareBodies(written, planned, all);
    compareForces(written, planned, all);
    all.text("solver.integrator", written.solver.integrator, planned.solver.integrator);
    if (written.solver.dt != planned.solver.dt)
        all.changes.push_back({"solver.dt", planned.solver.dt ? numberText(*planned.solver.dt) : "\"auto\""});
    all.number("solver.safety", written.solver.safety, planned.solver.safety);
    all.text("solver.precision", written.solver.precision == world::Precision::single_ ? "single" : "double",
             planned.solver.precision == world::Precision::single_ ? "single" : "double");
    compareOverrides(written, planned, world::World(planned, {.threads = 1}).islands(), all);
    return all.changes;
}

}  // namespace taut::study
