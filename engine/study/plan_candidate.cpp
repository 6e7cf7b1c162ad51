#include "taut/study/plan_candidate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "taut/core/error.h"
#include "taut/study/plan_bodies.h"
#include "taut/world/body.h"
#include "taut/world/targets.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

using world::SceneSpec;

constexpr int leastCells = 2;  // of a cloth or rope: a spring across two cells must fit in
constexpr double leastSafety = 0.01;
constexpr double springsACell = 5;  // a volume cell takes the time of so many springs (measured: 20 ns against 4)

bool namesPlaces(const std::string& selector) {
    return selector.find_first_of("#%(") != std::string::npos;
}

// The bodies, by base name, whose points a joint, an anchor or a place by number ties to their resolution.
void tieBodies(const SceneSpec& spec, std::map<std::string, std::string>& fixed) {
    std::vector<world::Body> bodies = world::buildBodies(spec);
    const std::vector<world::Body*> all = world::pointersTo(bodies);
    const auto tie = [&](const std::string& target, const std::string& why) {
        for (const world::Body* body : world::matchBodies(all, target))
            fixed.emplace(std::string(world::kindName(body->kind)) + "." + body->base, why);
    };
    for (const world::JointSpec& joint : spec.joints) {
        tie(joint.a, "a joint ties its points to others");
        tie(joint.b, "a joint ties its points to others");
    }
    for (const world::AnchorSpec& anchor : spec.anchors) tie(anchor.target, "anchors pull at single points of it");
    for (const world::MassSpec& mass : spec.masses)
        if (namesPlaces(world::parseTarget(mass.target).selector)) tie(mass.target, "a mass hangs at a single point");
}

int scaled(int count, double scale, int least) {
    return std::max(std::min(count, least), static_cast<int>(std::lround(count * scale)));
}

void scaleBodies(SceneSpec& spec, const Resolution& resolution, int count) {
    const double scale = static_cast<double>(count) / resolution.count;
    const auto isScalable = [&](const std::string& name) {
        return std::find(resolution.scalable.begin(), resolution.scalable.end(), name) != resolution.scalable.end();
    };
    for (world::ClothSpec& cloth : spec.cloths)
        if (isScalable("cloth." + cloth.name))
            for (int i = 0; i < 2; ++i) cloth.cells[i] = scaled(cloth.cells[i], scale, leastCells);
    for (world::RopeSpec& rope : spec.ropes)
        if (isScalable("rope." + rope.name)) rope.segments = scaled(rope.segments, scale, leastCells);
    for (world::BlockSpec& block : spec.blocks)
        if (isScalable("block." + block.name))
            for (int i = 0; i < 3; ++i) block.cells[i] = scaled(block.cells[i], scale, 1);
}

template <class Predicate>
bool anyBody(const SceneSpec& spec, const Predicate& predicate) {
    bool any = false;
    forEachBody(spec, [&](const auto& body) { any = any || predicate(body); });
    return any;
}

// To seven digits and a little up: readable, and as a maximum it allows the step itself.
double roundedUp(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value * (1 + 6e-7));
    return std::strtod(text, nullptr);
}

void dropWind(SceneSpec& spec, const std::string& which) {
    for (world::WindSpec& wind : spec.winds)
        if (wind.name == which) wind.drag = wind.lift = 0.0;
}

void dropDrag(SceneSpec& spec, const std::string&) {
    for (auto& [name, material] : spec.materials) material.drag = 0.0;
    for (auto& rope : spec.ropes) rope.drag = 0.0;
    for (auto& block : spec.blocks) block.drag = 0.0;
    for (auto& net : spec.nets) net.drag = 0.0;
}

void dropDamping(SceneSpec& spec, const std::string&) {
    for (auto& [name, material] : spec.materials) material.dampingTime = 0.0;
    for (auto& rope : spec.ropes) rope.dampingTime = 0.0;
    for (auto& block : spec.blocks) block.dampingTime = 0.0;
    for (auto& net : spec.nets) {
        net.dampingTime = 0.0;
        for (auto& spring : net.springs)
            if (spring.dampingTime) spring.dampingTime = 0.0;
    }
}

void dropBending(SceneSpec& spec, const std::string&) {
    for (auto& [name, material] : spec.materials) material.bend = 0.0;
    for (auto& rope : spec.ropes) rope.bend = 0.0;
}

void dropVolumes(SceneSpec& spec, const std::string&) {
    for (auto& block : spec.blocks) block.bulk = 0.0;
}

}  // namespace

std::vector<Generator> generatorsOf(const SceneSpec& spec) {
    std::vector<Generator> found;
    for (const world::WindSpec& wind : spec.winds)
        if (wind.drag > 0 || wind.lift > 0) found.push_back({"wind " + wind.name, dropWind, wind.name});
    const auto addIf = [&](const char* name, void (*leaveOut)(SceneSpec&, const std::string&), bool isThere) {
        if (isThere) found.push_back({name, leaveOut, ""});
    };
    const auto anyMaterial = [&](double world::MaterialSpec::*member) {
        return std::any_of(spec.materials.begin(), spec.materials.end(),
                           [&](const auto& entry) { return entry.second.*member > 0; });
    };
    addIf("drag", dropDrag,
          anyMaterial(&world::MaterialSpec::drag) || anyBody(spec, [](const auto& body) { return dragOf(body) > 0; }));
    addIf("inner friction", dropDamping,
          anyMaterial(&world::MaterialSpec::dampingTime) ||
              anyBody(spec, [](const auto& body) { return dampingOf(body) > 0; }));
    addIf("bend springs", dropBending,
          anyMaterial(&world::MaterialSpec::bend) ||
              std::any_of(spec.ropes.begin(), spec.ropes.end(), [](const auto& rope) { return rope.bend > 0; }));
    addIf("volume terms", dropVolumes,
          std::any_of(spec.blocks.begin(), spec.blocks.end(), [](const auto& block) { return block.bulk > 0; }));
    return found;
}

Resolution resolutionOf(const SceneSpec& spec) {
    Resolution resolution;
    tieBodies(spec, resolution.fixed);
    const auto add = [&](const std::string& name, const world::BodySpec& body, int count) {
        if (std::any_of(body.hold.begin(), body.hold.end(), namesPlaces))
            resolution.fixed.emplace(name, "it is held at single points");
        if (resolution.fixed.contains(name)) return;
        resolution.scalable.push_back(name);
        resolution.count = std::max(resolution.count, count);
    };
    for (const world::ClothSpec& cloth : spec.cloths) {
        if (cloth.meshData) resolution.fixed.emplace("cloth." + cloth.name, "its cells are those of a mesh file");
        add("cloth." + cloth.name, cloth, std::max(cloth.cells.x, cloth.cells.y));
    }
    for (const world::RopeSpec& rope : spec.ropes) add("rope." + rope.name, rope, rope.segments);
    for (const world::BlockSpec& block : spec.blocks)
        add("block." + block.name, block, std::max({block.cells.x, block.cells.y, block.cells.z}));
    for (const world::NetSpec& net : spec.nets)
        resolution.fixed.emplace("net." + net.name, "its points and springs are listed one by one");
    return resolution;
}

SceneSpec modelOf(const SceneSpec& spec, const Resolution& resolution, const Candidate& candidate) {
    SceneSpec model = spec;
    if (resolution.count > 0) scaleBodies(model, resolution, candidate.count);
    for (const Generator& generator : candidate.without) generator.leaveOut(model, generator.which);
    model.solver.integrator = candidate.method;
    model.solver.precision = candidate.precision;
    model.solver.dt.reset();
    model.solver.onDivergence = world::OnDivergence::stop;
    forEachBody(model, [](world::BodySpec& body) {
        body.jitter = 0.0;
        body.solver.integrator.reset();
        body.solver.dt.reset();
        body.solver.safety.reset();
    });
    return model;
}

StepFacts stepFacts(const SceneSpec& model) {
    StepFacts facts;
    try {
        const world::World world(model, {.threads = 1});
        facts.tick = world.tickSeconds();
        facts.islands = 0;
        facts.leastSubsteps = 0;
        for (const world::IslandInfo& island : world.islands()) {
            ++facts.islands;
            facts.springs += island.springs;
            facts.springSteps += static_cast<double>(island.springs) * island.substeps;
            facts.weightedSteps += (island.springs + springsACell * island.cells) * island.substeps;
            if (island.substeps <= facts.leastSubsteps) continue;
            facts.leastSubsteps = island.substeps;
            facts.limit = island.stepLimit;
        }
    } catch (const core::Error& error) {
        if (error.code() != core::ExitCode::badContent) throw;
        facts.isPossible = false;
    }
    return facts;
}

void setSubsteps(SceneSpec& model, const StepFacts& facts, int substeps) {
    if (substeps == 0 || substeps == facts.leastSubsteps) return;
    const double step = facts.tick / substeps;
    const double safety = step / facts.limit;
    if (facts.islands > 1 && std::isfinite(facts.limit) && safety > leastSafety && safety <= 1) {
        model.solver.safety = roundedUp(safety);
    } else {
        model.solver.dt = roundedUp(step);
    }
}

}  // namespace taut::study
