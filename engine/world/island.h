// One island in motion: its state, method and step. The interface hides the precision it was compiled for.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/core/hash.h"
#include "taut/world/envelope.h"
#include "taut/world/forces/force.h"
#include "taut/world/island_plan.h"
#include "taut/world/world.h"

namespace taut::world {

// When a tick is: whole numbers, from which every time is computed with one division.
struct TickTime {
    std::int64_t tick = 0;
    double ticksPerSecond = 60;
    // [s] at the start of substep s of n.
    double at(int s, int n) const { return (static_cast<double>(tick) * n + s) / (ticksPerSecond * n); }
    double start() const { return at(0, 1); }  // [s]
};

// Why an island stopped: the point whose velocity, or a spring of which, left all bounds, and when.
struct Fault {
    int point = -1;        // in the island
    double time = 0;       // [s]
    bool isNumber = true;  // false: NaN or infinite
    double strain = 0;     // above 0: of a spring at the point, over the one at which to freeze
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
    // Expects that the island is not open.
    virtual std::optional<Fault> tick(const TickTime& time, std::span<const ColliderMotion> moving) = 0;

    // After a tick that went well, at the time when it ends: springs give way and break. Whether any broke.
    virtual bool settle(const TickTime& time) = 0;

    // Puts the state back that the last tick began with.
    virtual void undoTick() = 0;

    // After a fault: back to the state before the step that failed, where it stays; its ticks do nothing any more.
    virtual void freeze(const Fault& fault, const TickTime& time) = 0;
    // What became of it, or null while it moves.
    virtual const FrozenIsland* frozen() const = 0;

    // Changes between two ticks. The first of them opens the island: its velocities are brought to the time of the
    // positions. close() starts the method again from there, on what the plan and the forces have become. A frozen
    // island is not to be changed.
    virtual void open(const TickTime& time) = 0;
    virtual void close(const TickTime& time) = 0;
    virtual bool isOpen() const = 0;
    // Opens; masses, springs and grips may be changed, the number of points may not.
    virtual IslandPlan& change(const TickTime& time) = 0;
    // Opens; adds to the velocity of points [m/s].
    virtual void push(const TickTime& time, std::span<const int> points, const dvec3& velocity) = 0;
    // Opens; the points stand still.
    virtual void stop(const TickTime& time, std::span<const int> points) = 0;
    // The way of a hand from now on; opens if `bends`. Does nothing where the hand has hold of nothing.
    virtual void lead(const TickTime& time, const std::string& hand, const mechanics::LinearPath& path, bool bends) = 0;
    // Opens where a force jumps; not if flows and gravity only go on changing.
    virtual void setForces(const TickTime& time, const ForceList& forces) = 0;

    virtual const IslandPlan& plan() const = 0;
    virtual double step() const = 0;  // [s]
    virtual dvec3 position(int point) const = 0;
    virtual std::span<const collision::Contact> contacts() const = 0;
    // (points) [m/s] at the time of the tick; zero when frozen. May cost an evaluation.
    virtual std::vector<dvec3> velocities(const TickTime& time) = 0;

    // x and the stored v of a body's points in the order of authoring.
    virtual void addToHash(const Body& body, core::Hash& hash) const = 0;
    // The same of one point.
    virtual void addPointToHash(int point, core::Hash& hash) const = 0;
    // Adds the share, at the time of the tick, of the bodies of this island that `wanted` names; velocities
    // synchronised.
    virtual void addMetrics(const TickTime& time, const std::function<bool(const Body&)>& wanted, Metrics& metrics) = 0;
    // Since the start.
    virtual ode::Work work() const = 0;
    virtual IslandInfo info() const = 0;
    // What to say before the first tick, and what has changed since (a working stretch left).
    virtual std::vector<std::string> warnings() const = 0;
    virtual Divergence diagnose(const Fault& fault, const TickTime& time) const = 0;

    // All that changes while it moves, written or read. Throws core::Error(badContent) for bytes that do not fit.
    virtual void visit(StateBytes& bytes) = 0;
};

// Builds the island at time t [s] and chooses its step, which holds for all that the envelope allows; throws
// core::Error(badContent) where no step would do.
std::unique_ptr<Island> makeIsland(IslandPlan plan, const ForceList& forces, Envelope envelope,
                                   double ticksPerSecond, double t);

}  // namespace taut::world
