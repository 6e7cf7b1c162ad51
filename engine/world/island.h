// One island in motion: its state, method and step. The interface hides the precision it was compiled for.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "collision/colliders.h"
#include "core/hash.h"
#include "mechanics/wind.h"
#include "world/island_plan.h"
#include "world/world.h"

namespace taut::world {

// When a tick is: whole numbers, from which every time is computed with one division.
struct TickTime {
    std::int64_t tick = 0;
    double ticksPerSecond = 60;
    // [s] at the start of substep s of n.
    double at(int s, int n) const {
        return (static_cast<double>(tick) * n + s) / (ticksPerSecond * n);
    }
};

// Why an island stopped: the point whose velocity, or a spring of which, left all bounds, and when.
struct Fault {
    int point = -1;        // in the island
    double time = 0;       // [s]
    bool isNumber = true;  // false: NaN or infinite
    double strain = 0;     // above 0: of a spring at the point, over the one at which to freeze
};

// What acts on the bodies of the scene besides their springs.
struct WindOn {
    dvec3 velocity{0.0};
    mechanics::WindSettings settings;
    std::vector<const Body*> bodies;
};
struct AnchorOn {
    dvec3 place{0.0};
    double stiffness = 0, damping = 0;
    const Body* body = nullptr;
    std::vector<int> points;  // of the body
};

struct IslandForces {
    dvec3 gravity{0.0};
    std::vector<WindOn> winds;
    std::vector<AnchorOn> anchors;
};

// The way of a moving collider during a tick.
struct ColliderMotion {
    int collider = 0;
    collision::Pose from, to;
};

class Island {
  public:
    virtual ~Island() = default;

    // Each island has colliders of its own: with other substeps they are elsewhere.
    virtual void setColliders(collision::Colliders colliders) = 0;

    // substeps steps of leap-frog or whichever method; contacts of the last step are kept. Ends early on a fault.
    virtual std::optional<Fault> tick(const TickTime& time, std::span<const ColliderMotion> moving) = 0;

    // Puts the state back that the last tick began with.
    virtual void undoTick() = 0;

    // After a fault: back to the state before the step that failed, where it stays; its ticks do nothing any more.
    virtual void freeze(const Fault& fault, const TickTime& time) = 0;
    // What became of it, or null while it moves.
    virtual const FrozenIsland* frozen() const = 0;

    virtual const IslandPlan& plan() const = 0;
    virtual double step() const = 0;  // [s]
    virtual dvec3 position(int point) const = 0;
    virtual std::span<const collision::Contact> contacts() const = 0;

    // x and the stored v of a body's points in the order of authoring.
    virtual void addToHash(const Body& body, core::Hash& hash) const = 0;
    // Adds this island's share at the time of the tick; velocities synchronised.
    virtual void addMetrics(const TickTime& time, Metrics& metrics) = 0;
    // Since the start.
    virtual ode::Work work() const = 0;
    virtual IslandInfo info() const = 0;
    // What to say before the first tick, and what has changed since (a working stretch left).
    virtual std::vector<std::string> warnings() const = 0;
    virtual Divergence diagnose(const Fault& fault, const TickTime& time) const = 0;
};

// Builds the island at time t [s] and chooses its step; throws core::Error(badContent) where no step would do.
std::unique_ptr<Island> makeIsland(IslandPlan plan, const IslandForces& forces, double ticksPerSecond,
                                   double t);

}  // namespace taut::world
