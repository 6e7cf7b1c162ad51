// What a world is made of, as plain data, for its sources and those of advice. What works on it stands by concern, each
// in a .cpp and a header of one name:
//
//   bodies        bodies come, each to an island, and go; what acts on them
//   colliders     where colliders are, and what they carry
//   timeline      actions when they are due, and the points that they name; actions/ what each kind does
//   hands         hands, and where they lead
//   ramps         fields of the scene that change while it runs
//   joints        what the joints of the scene tie, and what lets go
//   tick          islands go through a tick, and back
//   publish       the view for a picture
//   saving        all of it as bytes
//
// The class World itself is world.cpp, building and the tick, and queries.cpp, what is asked of it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "taut/bodies/private/joints/tie_drawing.h"
#include "taut/core/private/parallel.h"
#include "taut/island/private/island.h"
#include "taut/spec/spec.h"
#include "taut/world/components.h"
#include "taut/world/private/contact_report.h"
#include "taut/world/private/contact_stage.h"
#include "taut/world/private/hands.h"
#include "taut/world/private/ramps.h"
#include "taut/world/world_info.h"

namespace taut::world {

class World;
struct Options;

struct WorldImpl {
    SceneSpec spec;                          // as ramps have left it
    std::unique_ptr<const SceneSpec> start;  // the scene as it began: what envelopes are made from
    core::ThreadLimit threads;
    bool keepsSteps = false;
    ForceList added;  // by addForce()
    std::vector<std::function<void(World&, double t, double dt)>> systems;
    std::vector<std::string> callbackSystems;  // the names of those that are

    double ticksPerSecond = 60;
    int ticksPerFrame = 1;
    std::int64_t tick = 0;
    std::uint64_t hash = 0;

    // Entities; bodies and islands are theirs.
    ecs::Registry registry;
    struct Member {
        ecs::Entity entity;
        Body* body;
        std::string name;  // "cloth.flag"
    };
    std::vector<Member> bodies;                  // sorted by kind and name
    std::int64_t generation = 0;                 // rises when a body comes or goes
    std::vector<std::unique_ptr<Body>> waiting;  // bodies that an action will spawn
    std::vector<std::string> spawned;            // targets of the spawn actions so far
    std::vector<std::unique_ptr<Island>> islands;

    // Contact between bodies.
    std::unique_ptr<ContactStage> contactStage;  // of those that touch; null when it has to be made anew
    std::size_t goneAround = 0;                  // of bodies that touch, as it was made
    StepFollowing contactPace;                   // of theirs, as it presses; saved
    ContactReport contactReport;

    std::vector<Hand> hands;        // in the order of grabbing
    std::vector<Ramp> ramps;        // one for each key, in the order in which they began
    std::vector<JointInfo> joints;  // of the scene, as they tied bodies at the start
    std::vector<std::string> jointWarnings;
    std::vector<std::string> actionWarnings;  // of actions that found nothing to do
    std::vector<std::shared_ptr<const TieDrawing>> drawings;  // (joints of the scene) null: not drawn

    WorldImpl(const SceneSpec& scene, const Options& options);

    TickTime now() const { return {tick, ticksPerSecond}; }
    double seconds() const { return static_cast<double>(tick) / ticksPerSecond; }
};

// The way of actions into a world.
struct WorldAccess {
    static WorldImpl& of(World& world);
};

}  // namespace taut::world
