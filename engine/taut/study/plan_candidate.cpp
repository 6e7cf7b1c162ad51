#include "taut/study/plan_candidate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/bodies/rope.h"
#include "taut/body/body.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/forces/wind.h"
#include "taut/scene/fabrics.h"
#include "taut/scene/private/by_key.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

using world::SceneSpec;

constexpr int leastCells = 2;  // of a cloth or rope: a spring across two cells must fit in
constexpr double leastSafety = 0.01;
constexpr double springsACell = 5;  // a volume cell takes the time of so many springs (measured: 20 ns against 4)
constexpr double splitting = 2.2;   // cost of a step that splits the dashpots off, over that of one that does not

// A fabric of the library stays as it was measured: a scene file has no place to change it.
bool isOfLibrary(const std::pair<const std::string, world::MaterialSpec>& material) {
    return material.first.starts_with(scene::fabricPrefix);
}

bool namesPlaces(const std::string& selector) {
    return selector.find_first_of("#%(") != std::string::npos;
}

// The bodies, by base name, whose points a joint, an anchor or a place by number ties to their resolution.
void tieBodies(const SceneSpec& spec, std::map<std::string, std::string>& fixed) {
    std::vector<world::Body> bodies = world::buildBodies(spec);
    const std::vector<world::Body*> all = world::pointersTo(bodies);
    const auto tie = [&](const std::string& target, const std::string& why) {
        for (const world::Body* body : world::matchBodies(all, target)) fixed.emplace(body->spec->fullName(), why);
    };
    for (const world::JointSpec& joint : spec.joints) {
        for (const world::JointSide& side : {joint.a, joint.b})
            for (const std::string& target : side.targets) tie(target, "a joint ties its points to others");
    }
    for (const world::ForceSpec& force : spec.forces)
        if (!force.pulledPoints().empty())
            tie(std::string(force.pulledPoints()), "anchors pull at single points of it");
    for (const world::MassSpec& mass : spec.masses)
        if (namesPlaces(world::parseTarget(mass.target).selector)) tie(mass.target, "a mass hangs at a single point");
}

// Layers of a body keep twice its thickness, and its own cells must not be smaller than that; as written they may.
void limitCells(const SceneSpec& spec, Resolution& resolution) {
    if (!world::bodiesTouch(spec)) return;
    for (const world::Body& body : world::buildBodies(withoutJitter(spec))) {
        const auto& scalable = resolution.scalable;
        const bool isScalable = core::contains(scalable, body.spec->fullName());
        if (!isScalable || body.spec->touch == world::Touch::nothing || !(body.spec->thickness > 0)) continue;
        const double finer = std::max(1.0, world::shortestEdge(body) / (2 * body.spec->thickness));
        resolution.most = static_cast<int>(
            std::min(static_cast<double>(resolution.most), std::floor(resolution.count * finer * (1 + 1e-9))));
    }
}

int scaled(int count, double scale, int least) {
    return std::max(std::min(count, least), static_cast<int>(std::lround(count * scale)));
}

void scaleBodies(SceneSpec& spec, const Resolution& resolution, int count) {
    const double scale = static_cast<double>(count) / resolution.count;
    const auto isScalable = [&](const std::string& name) { return core::contains(resolution.scalable, name); };
    for (world::ClothSpec& cloth : spec.bodies.of<world::ClothSpec>())
        if (isScalable(cloth.fullName()))
            for (int i = 0; i < 2; ++i) cloth.cells[i] = scaled(cloth.cells[i], scale, leastCells);
    for (world::RopeSpec& rope : spec.bodies.of<world::RopeSpec>())
        if (isScalable(rope.fullName())) rope.segments = scaled(rope.segments, scale, leastCells);
    for (world::BlockSpec& block : spec.bodies.of<world::BlockSpec>())
        if (isScalable(block.fullName()))
            for (int i = 0; i < 3; ++i) block.cells[i] = scaled(block.cells[i], scale, 1);
}

// To seven digits and a little up: readable, and as a maximum it allows the step itself.
double roundedUp(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value * (1 + 6e-7));
    return std::strtod(text, nullptr);
}

}  // namespace

Generators generatorsOf(const SceneSpec& spec) {
    Generators all;
    for (const world::WindSpec& wind : spec.forces.of<world::WindSpec>())
        all.push_back({"wind " + wind.name, {"drag", "lift"}, wind.fullName(), false});
    for (const Generator& generator :
         {Generator{"drag", {"drag_per_s"}, "", false}, Generator{"inner friction", {"damping_time_s"}},
          Generator{"bend springs", {"bend_N_per_m", "bend_N"}}, Generator{"volume terms", {"bulk_Pa"}}})
        all.push_back(generator);
    SceneSpec scene = spec;
    std::erase_if(scene.materials, isOfLibrary);
    std::erase_if(all, [&](const Generator& generator) {
        bool isThere = false;
        scene::eachNumber(scene, generator.owner, generator.keys, [&](double& x) { isThere = isThere || x > 0; });
        return !isThere;
    });
    return all;
}

Resolution resolutionOf(const SceneSpec& spec) {
    Resolution resolution;
    tieBodies(spec, resolution.fixed);
    const auto add = [&](const world::BodySpec& body, int count) {
        const std::string name = body.fullName();
        if (std::ranges::any_of(body.hold, namesPlaces)) resolution.fixed.emplace(name, "it is held at single points");
        if (resolution.fixed.contains(name)) return;
        resolution.scalable.push_back(name);
        resolution.count = std::max(resolution.count, count);
    };
    for (const world::ClothSpec& cloth : spec.bodies.of<world::ClothSpec>()) {
        if (cloth.meshData) resolution.fixed.emplace(cloth.fullName(), "its cells are those of a mesh");
        if (cloth.isRound) resolution.fixed.emplace(cloth.fullName(), "it is round, and other cells have another hem");
        add(cloth, std::max(cloth.cells.x, cloth.cells.y));
    }
    for (const world::RopeSpec& rope : spec.bodies.of<world::RopeSpec>()) add(rope, rope.segments);
    for (const world::BlockSpec& block : spec.bodies.of<world::BlockSpec>()) {
        if (block.meshData) resolution.fixed.emplace(block.fullName(), "its cells fill a mesh");
        add(block, std::max({block.cells.x, block.cells.y, block.cells.z}));
    }
    for (const world::NetSpec& net : spec.bodies.of<world::NetSpec>())
        resolution.fixed.emplace(net.fullName(), "its points and springs are listed one by one");
    limitCells(spec, resolution);
    return resolution;
}

double costOf(const world::IslandInfo& island) {
    return (island.springs + island.points + springsACell * island.cells) * (island.splitsDashpots ? splitting : 1.0);
}

SceneSpec withoutJitter(SceneSpec spec) {
    for (world::BodySpec& body : spec.bodies) body.jitter = 0.0;
    return spec;
}

SceneSpec modelOf(const SceneSpec& spec, const Resolution& resolution, const Candidate& candidate) {
    SceneSpec model = withoutJitter(spec);
    if (resolution.count > 0) scaleBodies(model, resolution, candidate.count);
    for (const Generator& generator : candidate.without)
        scene::eachNumber(model, generator.owner, generator.keys, [](double& strength) { strength = 0.0; });
    for (auto& material : model.materials)
        if (isOfLibrary(material)) material.second = spec.materials.at(material.first);
    model.solver.integrator = candidate.method;
    model.solver.precision = candidate.precision;
    model.solver.dt.reset();
    model.solver.onDivergence = world::OnDivergence::stop;
    model.solver.sleepError = 0.0;
    for (world::BodySpec& body : model.bodies) {
        body.solver.integrator.reset();
        body.solver.dt.reset();
        body.solver.safety.reset();
    }
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
            facts.cost += costOf(island);
            facts.stepCost += costOf(island) * island.substeps;
            if (island.substeps <= facts.leastSubsteps) continue;
            facts.leastSubsteps = island.substeps;
            facts.limit = island.stepLimit;
        }
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::badContent) throw;
        facts.isPossible = false;
    }
    return facts;
}

void setSubsteps(SceneSpec& model, const StepFacts& facts, int substeps) {
    if (substeps == 0 || substeps == facts.leastSubsteps) return;
    const double step = facts.tick / substeps;
    const double safety = model.solver.safety * facts.leastSubsteps / substeps;
    const bool isStableByHand = step <= model.solver.safety * facts.limit;
    if ((facts.islands > 1 || !isStableByHand) && std::isfinite(facts.limit) && safety > leastSafety && safety <= 1)
        model.solver.safety = roundedUp(safety);
    else
        model.solver.dt = roundedUp(step);
}

}  // namespace taut::study
