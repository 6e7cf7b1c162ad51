// Worlds that answer queries, are saved and restored while they play: none of it may change their motion. Without GoogleTest.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "taut/core/error.h"
#include "taut/core/private/instruction_set.h"
#include "taut/spec/spec.h"
#include "taut/view/frame_view.h"
#include "taut/world/components.h"
#include "taut/world/private/body_surfaces.h"
#include "taut/world/world.h"

namespace taut::support {

// Why a figure that the world gives is no number; empty where all are.
inline std::string notANumber(const world::World& world, const world::Metrics& m) {
    for (double figure : {m.kinetic, m.elastic, m.gravitational, m.momentum.x, m.momentum.y, m.momentum.z,
                          m.angularMomentum.x, m.angularMomentum.y, m.angularMomentum.z, m.maxStrain, m.volume,
                          m.restVolume, m.penetration, m.facePenetration, m.minVolumeRatio})
        if (!std::isfinite(figure)) return "a metric is not a number at tick " + std::to_string(world.tick());
    for (const world::BodyHash& body : world.bodyHashes()) {
        const world::PointsNow points = world.points(body.name);
        for (const auto* list : {&points.x, &points.v})
            for (const glm::dvec3& v : *list)
                if (!std::isfinite(glm::dot(v, v)))
                    return "a point of " + body.name + " is not a number at tick " + std::to_string(world.tick());
    }
    return "";
}

// All that a world may be asked between two ticks.
inline world::Metrics askEverything(world::World& world) {
    const world::Metrics metrics = world.metrics();
    std::vector<world::Selection> bodies;
    for (const world::BodyHash& body : world.bodyHashes()) {
        (void)world.metrics(body.name);
        bodies.push_back(world.select(body.name));
        (void)world.points(bodies.back());
        (void)world.positions(bodies.back());
    }
    if (bodies.size() > 1) (void)world::BodySurfaces(bodies[0], bodies[1]).gap();
    world.registry().each<world::BodyPart>([&](ecs::Entity body, const auto&) { (void)world.pointHashes(body); });
    for (bool debug : {false, true}) (void)world.view(debug);
    (void)world.viewAhead(0.001);
    (void)world.islands();
    (void)world.contact();
    (void)world.joints();
    (void)world.work();
    (void)world.hasTouched();
    (void)world.frozen();
    (void)world.warnings();
    (void)world.callbacks();
    (void)world.save();
    return metrics;
}

struct Playing {
    std::int64_t ticks = 5;
    std::int64_t evaluations = std::int64_t{1} << 40U;   // of forces, after which it ends
    std::vector<int> threads{1};                         // tick after tick, round and round
    std::optional<core::InstructionSet> instructions{};  // those in use
    int asksEvery = 0;                                   // ticks; 0: nothing is asked
    int restoresEvery = 0;  // ticks, after which a new world goes on from the saved bytes; 0: it is one world
};

struct Played {
    std::vector<std::uint64_t> hashes;  // (ticks + 1), fewer where it ended early
    std::string end;                    // why; empty where it went through
    std::string fault;                  // never allowed: figures that are not numbers; of one that is asked
    // The most that energy rose, over the most that ever moved or was stretched; of one that is asked.
    double gain = 0;
    bool hasTouched = false;
};

// The result of its queries.
class Observation {
  public:
    void look(world::World& world, Played& played) {
        const world::Metrics m = askEverything(world);
        if (played.fault.empty()) played.fault = notANumber(world, m);
        least_ = std::min(least_, m.energy());
        moved_ = std::max(moved_, m.kinetic + m.elastic);
        if (moved_ > 0) played.gain = std::max(played.gain, (m.energy() - least_) / moved_);
    }

  private:
    double least_ = HUGE_VAL, moved_ = 0;  // [J]
};

// An exception of a world ends its play.
inline Played play(const world::SceneSpec& scene, const Playing& how) {
    const core::InstructionSet before = core::instructionSet();
    core::useInstructionSet(how.instructions.value_or(before));
    const auto made = [&](std::int64_t tick) {
        return world::World(scene, {.threads = how.threads[static_cast<std::size_t>(tick) % how.threads.size()]});
    };
    const auto isDue = [](int every, std::int64_t tick) { return every > 0 && tick % every == 0; };
    world::World world = made(0);
    Played played;
    played.hashes = {world.stateHash()};
    Observation observation;
    try {
        while (world.tick() < how.ticks && world.work().evaluations < how.evaluations && played.end.empty()) {
            if (isDue(how.asksEvery, world.tick())) observation.look(world, played);
            if (isDue(how.restoresEvery, world.tick())) {
                const std::vector<std::byte> bytes = world.save();
                world = made(world.tick());
                world.restore(bytes);
            }
            if (const auto divergence = world.advance())
                played.end = divergence->message;
            else
                played.hashes.push_back(world.stateHash());
        }
        if (how.asksEvery > 0 && played.end.empty()) observation.look(world, played);
        played.hasTouched = world.hasTouched();
    } catch (const core::Error& error) {
        played.end = error.what();
    }
    core::useInstructionSet(before);
    return played;
}

// The difference of two plays of one scene; empty where they do not.
inline std::string differenceOf(const Played& a, const Played& b) {
    const auto [x, y] = std::mismatch(a.hashes.begin(), a.hashes.end(), b.hashes.begin(), b.hashes.end());
    if (x != a.hashes.end() && y != b.hashes.end())
        return "other states from tick " + std::to_string(x - a.hashes.begin()) + " on";
    if (a.end == b.end && a.hashes.size() == b.hashes.size()) return "";
    return "one ends with \"" + a.end + "\", the other with \"" + b.end + "\"";
}

}  // namespace taut::support
