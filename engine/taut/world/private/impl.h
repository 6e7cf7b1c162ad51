// The data of a world, for its own sources and those of advice. Each concern has its functions in a .cpp and a header
// of the same name:
//
//   bodies        bodies come, each to an island, and go; forces on them
//   colliders     places of colliders, and the points that they carry
//   timeline      actions that are due, and the points that they name; actions/ has each kind
//   hands         hands and their ways
//   ramps         fields of the scene that change during the run
//   joints        ties of the scene's joints, and their release
//   tick          takes islands through a tick, or back
//   publish       the view for a picture
//   saving        all of it as bytes
//
// World itself is in world.cpp, which builds and ticks, and in queries.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "taut/core/private/parallel.h"
#include "taut/drawing/private/tie_drawing.h"
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
    SceneSpec spec;                          // as ramps have changed it
    std::unique_ptr<const SceneSpec> start;  // the scene at the start: envelopes are made from it
    int threadCount = 0;
    core::ThreadLimit threads;
    bool keepsSteps = false;
    ForceList added;  // by addForce()
    std::vector<std::function<void(World&, double t, double dt)>> systems;
    std::vector<std::string> callbackSystems;  // names of the systems that call back

    double ticksPerSecond = 60;
    int ticksPerFrame = 1;
    std::int64_t tick = 0, startTick = 0;
    std::uint64_t hash = 0;

    // Entities own bodies and islands.
    ecs::Registry registry;
    struct Member {
        ecs::Entity entity;
        Body* body;
        std::string name;  // "cloth.flag"
    };
    std::vector<Member> bodies;                  // sorted by kind and name
    std::int64_t generation = 0;                 // increases when a body comes or goes
    std::vector<std::unique_ptr<Body>> waiting;  // bodies that an action will spawn
    std::vector<std::string> spawned;            // targets of the spawn actions so far
    std::vector<std::unique_ptr<Island>> islands;

    // Contact between bodies.
    std::unique_ptr<ContactStage> contactStage;  // of bodies that touch; null: to be made anew
    std::uint64_t contactTies = 0;               // of exposed faces and holding ties, when the stage was made
    StepFollowing contactPace;                   // pace of the contact stage; saved
    std::vector<contact::KeptForce> keptForces;  // of its contacts as the last tick ended; saved
    ContactReport contactReport;

    std::vector<Hand> hands;        // in the order of grabbing
    std::vector<Ramp> ramps;        // one for each key, in the order in which they began
    std::vector<JointInfo> joints;  // of the scene, as they tied bodies at the start
    std::vector<core::Finding> jointWarnings;
    std::vector<core::Finding> actionWarnings;                // of actions that found nothing to do
    std::vector<std::shared_ptr<const TieDrawing>> drawings;  // (joints of the scene) null: not drawn

    WorldImpl(const SceneSpec& scene, const Options& options);

    TickTime now() const { return {tick, ticksPerSecond}; }
    double seconds() const { return static_cast<double>(tick) / ticksPerSecond; }
};

// Gives actions access to a world.
struct WorldAccess {
    static WorldImpl& of(World& world);
};

}  // namespace taut::world
