// What a world is made of, shared by its sources only.
//
//   joints.cpp         what the joints of the scene tie, and what lets go
//   world.cpp          building, the tick, what is asked of a world
//   timeline.cpp       actions when they are due, and the points that they name
//   actions/           what each kind of action does
//   hands.cpp          where hands are, and where colliders carry what is tied to them
//   ramps.cpp          fields of the scene that change while it runs
//   queries.cpp        metrics, contact, warnings, points, hashes
//   saving.cpp         all of it as bytes
//   publish.cpp        the view for a picture
//   rehearsal.cpp      what a run would refuse later
//   encounters.cpp     which bodies come into each other's way
//   start_doubts.cpp   what a scene hardly means
#pragma once

#include <optional>

#include "taut/bodies/private/joints/tie_drawing.h"
#include "taut/core/private/parallel.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"
#include "taut/world/components.h"
#include "taut/world/private/hands.h"
#include "taut/island/private/island.h"
#include "taut/world/private/contact_report.h"
#include "taut/world/private/contact_stage.h"
#include "taut/world/world.h"

namespace taut::world {

// A field on its way; one that has arrived is kept, as its value is no longer the scene's own.
struct Ramp {
    RampAction action;
    std::vector<double> from;
    std::int64_t start = 0;   // tick
    std::int64_t length = 0;  // ticks; 0: at once
};

// A point that an action names.
struct Picked {
    Island* island = nullptr;
    const Body* body = nullptr;
    int point = -1;  // in the island
};

struct World::Impl {
    SceneSpec spec;  // as ramps have left it
    core::ThreadLimit threads;
    bool keepsSteps = false;
    ecs::Registry registry;
    std::vector<System> systems;
    std::vector<std::string> callbackSystems;  // the names of those that are
    ForceList added;  // by addForce()
    std::vector<std::unique_ptr<Island>> islands;
    std::unique_ptr<ContactStage> contactStage;  // of those that touch; null when it has to be made anew
    std::size_t goneAround = 0;          // of bodies that touch, as it was made
    StepFollowing contactPace;           // of theirs, as it presses; saved
    ContactReport contactReport;
    struct Member {
        ecs::Entity entity;
        Body* body;
        std::string name;  // "cloth.flag"
    };
    std::vector<Member> bodies;  // sorted by kind and name
    double ticksPerSecond = 60;
    int ticksPerFrame = 1;
    std::int64_t tick = 0;
    std::uint64_t hash = 0;
    std::int64_t generation = 0;  // rises when a body comes or goes

    std::unique_ptr<const SceneSpec> start;      // the scene as it began: what envelopes are made from
    std::vector<std::unique_ptr<Body>> waiting;  // bodies that an action will spawn
    std::vector<std::string> spawned;            // targets of the spawn actions so far
    std::vector<JointInfo> joints;               // of the scene, as they tied bodies at the start
    std::vector<std::string> jointWarnings;
    std::vector<std::shared_ptr<const TieDrawing>> drawings;  // (joints of the scene) null: not drawn
    std::vector<Hand> hands;  // in the order of grabbing
    std::vector<Ramp> ramps;  // one for each key, in the order in which they began

    Impl(const SceneSpec& scene, const Options& options);

    TickTime now() const { return {tick, ticksPerSecond}; }
    double seconds() const { return static_cast<double>(tick) / ticksPerSecond; }

    void addBodies();
    void addIsland(IslandPlan plan, const ForceList& current, const Envelopes& envelopes, bool hasJoints);
    ForceList forces() const;
    void checkUntied(Body& body) const;
    void takeJoints(const std::vector<JointReport>& reports);
    bool isJoint(const std::string& name) const;
    void releaseJoints(const std::string& name);
    void breakJoints();  // that the last tick has overloaded
    int jointsLeft(const JointInfo& info) const;
    void checkForces() const;
    collision::Colliders colliders() const;  // where they are now
    void rebuildColliders();
    std::vector<TouchedCollider> met() const;  // colliders as the contact stage asks for them
    ecs::Entity addCollider(const ColliderSpec& collider);
    Member addBody(std::unique_ptr<Body> body);
    ecs::Entity spawn(Body body);
    ecs::Entity addAlone(std::unique_ptr<Body> body);
    void makeContactStage();
    std::optional<Divergence> tickIslands(const std::vector<ColliderMotion>& moving);
    void placeColliders();
    std::vector<ColliderMotion> movingColliders();
    void undoTick();
    void updateHash();
    void redrawDamage();
    Island& islandOf(const Body& body) const;
    std::vector<Body*> allBodies() const;

    // The actions of the scene whose tick it is, in `world`, which this is.
    void performDue(World& world);
    // The points that it names, each once, ascending by island; only the nearest if it says where. Throws
    // core::Error(badContent) if there is none.
    std::vector<Picked> pick(const PointsAction& action) const;
    // Whether any body of that name was waiting.
    bool spawnWaiting(const std::string& target);
    void closeIslands();

    // Throws core::Error(badContent) if there is none of that name.
    Hand& handOf(const ActionSpec& action, const std::string& id);
    void leadHands();
    // Where colliders carry what is tied to them in the coming tick.
    void carryTied();
    void letGo(const std::string& collider);  // of all that is tied to it
    std::optional<collision::Pose> poseOf(const std::string& collider) const;

    // Writes the values at this tick, or at a moment between two, into the scene; only of those that affect `which`.
    void applyRamps(double moment, fields::Affects which);
    void changeForces();
    void changeSprings();
    void changeColliders();
    void changePicture();
    void takeRampedParts();
    bool isRamping(fields::Affects which) const;
    void takeSprings(Body& body) const;

    Metrics metricsOf(const std::function<bool(const Body&)>& wanted, Measures what);
    bool touchesAny() const;
    std::vector<BodyCrossing> crossings();

    // Reading, `applied` are ramps that it may have besides those of the scene.
    void visit(StateBytes& bytes, std::span<const RampAction> applied = {});
};

// The way of actions into a world.
struct WorldAccess {
    using Impl = World::Impl;
    static Impl& of(World& world) { return *world.impl_; }
};
using WorldImpl = WorldAccess::Impl;

double massOf(const Picked& point);  // [kg]
// The islands of picked points with their points in each, in order; frozen ones are left out.
std::vector<std::pair<Island*, std::vector<int>>> byIsland(const std::vector<Picked>& points);

[[noreturn]] void failAction(const ActionSpec& action, const std::string& message);

}  // namespace taut::world
