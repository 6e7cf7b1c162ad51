// One island: the bodies that move together, their state, and the operations on them. island_report.h reports on it.
//
//   island.cpp          ticks, and changes between two ticks
//   island_saving.cpp   its bytes
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/core/aabb.h"
#include "taut/core/private/hash.h"
#include "taut/island/private/dynamics.h"
#include "taut/island/private/envelope.h"
#include "taut/island/private/memory.h"
#include "taut/island/private/precision_watch.h"
#include "taut/island/private/rest_watch.h"
#include "taut/island/private/step_choice.h"
#include "taut/island/private/step_following.h"
#include "taut/island/private/tie_load.h"
#include "taut/island/private/yielding.h"
#include "taut/island/report.h"

namespace taut::world {

// When a tick is, in whole numbers. Every time is computed from them with one division.
struct TickTime {
    std::int64_t tick = 0;
    double ticksPerSecond = 60;
    // [s] at the start of substep s of n.
    double at(int s, int n) const { return (static_cast<double>(tick) * n + s) / (ticksPerSecond * n); }
    double start() const { return at(0, 1); }  // [s]
    double end() const { return at(1, 1); }    // [s]
};

// Why an island stopped, and when: a velocity or a spring left all bounds at a point.
struct Fault {
    int point = -1;           // in the island
    double time = 0;          // [s]
    bool isNumber = true;     // false: NaN or infinite
    bool byContact = false;   // contact with other bodies was the last that moved it
    bool isTooStiff = false;  // needs more than a million steps a tick
    double strain = 0;        // above 0: strain of a spring at the point, beyond the strain at which to freeze
};

// How a moving collider moves during a tick.
struct ColliderMotion {
    int collider = 0;
    collision::Pose from, to;
};

// The outcome of one try of a tick.
enum class TickVerdict { stands, again, fails };

// [rad] Largest ω H of the motion that contact causes. H is the time from one step of contact to the next.
// With one each step (2 is the limit of leap-frog) an impulse is one more force of the step's kick, and contact
// without restitution takes energy: ΔE = ½ λ (u' + u), never above 0, with u' the approach after it and u that in the
// step before. Moving points back over several steps works against their springs: at ω H = 3 these gain several times ½
// m u².
inline constexpr double longestTurn = 2.0;

class Island {
  public:
    // Starts at time t [s]. Chooses a step that holds for all that the envelope allows. Throws core::Error(badContent)
    // where no step would do. With `keepsStep` no state changes the step. The substeps of a tick can be divided into
    // `parts`, a power of two; fewer substeps than that are a power of two.
    Island(IslandPlan plan, const ForceList& forces, const Envelope& envelope, double ticksPerSecond, double t,
           bool keepsStep, int parts = 1);
    Island(const Island&) = delete;
    Island& operator=(const Island&) = delete;

    // Each island has its own colliders, because with other substeps they are at other places. The first call finds the
    // points that stand inside one. names (colliders): "collider.ground", …
    void setColliders(collision::Colliders colliders, std::span<const std::string> names);

    // Takes all substeps of a tick and keeps the contacts of the last one. Ends early on a fault. Expects that the
    // island is not open.
    std::optional<Fault> tick(const TickTime& time, std::span<const ColliderMotion> moving);

    // A tick in pieces, for islands whose bodies touch others: beginTick(), then tries until one stands. A try begins,
    // advances by parts of all substeps, and is judged. After `again` the island starts another try from the start of
    // the tick. It may have to do so for the sake of other islands.
    void beginTick(const TickTime& time);
    void beginTry();
    std::optional<Fault> advance(const TickTime& time, std::span<const ColliderMotion> moving, int part, int parts);
    // Moves colliders as in one substep of the tick.
    void moveColliders(std::span<const ColliderMotion> moving, int substep);
    TickVerdict judge(const TickTime& time, std::optional<Fault>& fault);
    void tryAgain(const TickTime& time, TickVerdict verdict);
    void endTick(const TickTime& time);
    int substeps() const { return now_.substeps; }
    bool keepsStep() const { return keepsStep_; }
    // Steps of contact in a tick that are enough however the island is pressed: one each step, or fewer where steps
    // are very short and nothing bounces. The fastest motion turns by at most longestTurn between two.
    int stepsToPress(bool bounces) const;
    // Makes all substeps of a tick divisible by so many parts from now on. To be called between two tries.
    void takeParts(const TickTime& time, int parts);
    // Positions and velocities of the points, velocities as the method stores them (points) [m], [m/s].
    void read(std::span<dvec3> x, std::span<dvec3> v) const;
    // After a part: contact with other bodies has moved points (ascending). Brings them out of colliders again.
    void place(std::span<const int> points, std::span<dvec3> x, std::span<dvec3> v);
    // After place(): constraints share its changes. Returns whether any point of the island moved.
    bool settle() { return !isStill() && dynamics_->settle(); }
    // Pairs that constraints hold at t [s]; until the next call.
    std::span<const HeldPair> heldPairs(double t) const { return dynamics_->heldPairs(t); }
    // After the last part: takes over the accelerations by contact with other bodies in the last step.
    void bear(std::span<const ContactAcceleration> pressed) { now_.pressed.assign(pressed.begin(), pressed.end()); }
    std::span<const ContactAcceleration> pressed() const { return now_.pressed; }

    // Whether any spring tore in the last tick.
    bool hasTorn() const { return yielding_.hasTorn(); }

    // Begins constraints that are due.
    void beginConstraints(const TickTime& time);
    // (ties of joints) whether the mean force through a tie over the last tick was more than it bears.
    std::vector<bool> overloaded() const;

    // Returns to the state at the start of the last tick.
    void undoTick();

    // After a fault: goes back to the state before the failed step and stays there. Later ticks do nothing.
    void freeze(const Fault& fault, const TickTime& time);
    // Why and when it froze, or null while it moves.
    const FrozenIsland* frozen() const { return frozen_ ? &*frozen_ : nullptr; }

    // Sleep: world/private/sleep.h decides. An island that sleeps keeps its places to the bit, at speed 0, and later
    // ticks do nothing. Changes open it as any other; then it has to be woken before close().
    bool isAsleep() const { return sleep_.company != 0; }
    // The number of the islands that fell asleep together, and wake together; 0: awake.
    std::int64_t company() const { return sleep_.company; }
    bool isStill() const { return isAsleep() || frozen_; }
    // At the end of a tick, while awake. A window of rest ends, and the next begins, or it is looked at in between.
    void watchRest(bool isMiddle);
    void beginRestWindow(std::int64_t number);
    // At the end of a window: whether it was calm, and the forces on the points are steady.
    bool isCalm();
    // Whether no point of a calm island could go further than the error allows. supports (points; empty: none): by
    // other bodies, with those of colliders to come. footholds: where solids are pressed. t [s]: now.
    struct Support {
        dvec3 push{0.0};        // direction of the pressure on the point; 0: none
        bool mayStick = false;  // friction could hold it by a margin
    };
    struct Foothold {
        const Body* body;
        dvec3 place;             // [m]
        double friction, limit;  // [N s] and by Coulomb's law at most
        bool resistsRolling;
        bool isOnCollider;
    };
    bool rests(double t, double seconds, std::vector<Support> supports, std::span<const Foothold> footholds);
    void restInVain() { rest_.fail(); }
    // Takes the motion that is left, and books it.
    void fallAsleep(const TickTime& time, std::int64_t company);
    // Opens it.
    void wake();
    // While it sleeps: whether a collider that moves in this tick comes near any point. Moves its colliders.
    bool isReachedBy(std::span<const ColliderMotion> moving);
    struct Slept {
        double energy = 0;    // [J]
        dvec3 momentum{0.0};  // [kg m/s]
    };
    // Energy and momentum lost by falling asleep since the start.
    const Slept& slept() const { return sleep_.taken; }

    // Changes between two ticks. The first one opens the island: velocities are brought to the time of the positions.
    // close() starts the method again from there, with the changed plan and forces. Expects that the island is not
    // frozen.
    void open(const TickTime& time);
    void close(const TickTime& time);
    bool isOpen() const { return isOpen_; }
    // Opens; returns the plan, in which this part may be changed. Points and springs keep their number and their ends.
    IslandPlan& change(const TickTime& time, Change what);
    // Opens; adds to the velocity of points [m/s].
    void push(const TickTime& time, std::span<const int> points, const dvec3& velocity);
    // Opens; the points stand still.
    void stop(const TickTime& time, std::span<const int> points);
    // Sets the path of a hand from now on; opens if it `bends`. Does nothing where the hand holds nothing.
    void lead(const TickTime& time, const std::string& hand, const mechanics::PosePath& path, bool bends);
    // Sets the path of a collider, "collider.pole"; opens where it does not go on from the path before.
    void carry(const TickTime& time, const std::string& collider, const mechanics::PosePath& path);
    // Releases the wanted ties of joints; opens if any of them holds.
    void release(const TickTime& time, const std::function<bool(const JointTie&)>& wanted);
    // Takes over the forces. Opens where a force jumps, but not where wind and gravity change steadily.
    void setForces(const TickTime& time, const ForceList& forces);

    // Whether a force that acts here is a callback. Such islands take their ticks one after another.
    bool callsBack() const { return dynamics_->callsBack(forces_); }

    const IslandPlan& plan() const { return plan_; }
    double step() const { return now_.step; }  // [s]
    dvec3 position(int point) const { return dynamics_->position(point); }
    std::span<const collision::Contact> contacts() const { return now_.contacts; }
    bool hasTouched() const { return now_.hasTouched; }  // anything, in any step so far
    // (points) [m/s] at the time of the tick; zero when frozen. May cost an evaluation.
    std::vector<dvec3> velocities(const TickTime& time);

    // The state of a body: x and the stored v of its points in the order of authoring, and its other state.
    void addToHash(const Body& body, core::Hash& hash) const { dynamics_->addToHash(body, hash); }
    // The same as one number, kept while it sleeps.
    std::uint64_t hashAsleep(const Body& body);
    // Adds x and the stored v of one point.
    void addPointToHash(int point, core::Hash& hash) const { dynamics_->addToHash({&point, 1}, hash); }
    // Work of the methods since the start.
    ode::Work work() const;
    // Why its step will end the run, with file, line and remedy; empty where it will not.
    const std::optional<core::Finding>& fault() const { return choice_.fault; }

    // For island_report.h.
    const Dynamics& dynamics() const { return *dynamics_; }
    Dynamics& dynamics() { return *dynamics_; }
    const IslandMemory& memory() const { return now_; }
    StepChoice choice() const;  // with the present number of steps
    const collision::Colliders& colliders() const { return colliders_; }
    // The product with the stiffness of the island at positions x. Expects that x outlives it.
    mechanics::StiffnessProduct stiffnessAt(std::span<const dvec3> x) const;
    bool hasMoved() const { return hasMoved_; }  // any tick yet
    std::vector<std::string> said() const;       // warnings so far that cannot be computed again

    // Writes or reads all that changes while it moves. Throws core::Error(badContent) for bytes that do not fit.
    void visit(StateBytes& bytes);

  private:
    std::optional<Fault> takeSubsteps(const TickTime& time, std::span<const ColliderMotion> moving, int first,
                                      int last);
    TickVerdict judgeSteps(const TickTime& time, std::optional<Fault>& fault);
    // Expects velocities at the time of the positions.
    void startWith(const TickTime& time, int substeps, bool isRepeated);
    std::optional<Fault> overstrained(double t);
    Fault giveUp(double t) const;
    void findInside(std::span<const std::string> names);
    void watchVolumes(double t);
    void watchLimit(double t);
    void setPath(std::size_t grip, const mechanics::PosePath& path);
    bool addsTooMuch(const ContactWork& work) const;
    int inParts(int substeps) const;
    int quietSubsteps() const {  // while nothing presses it
        return inParts(now_.budget.factor * (choice_.need ? now_.following.substeps() : ownSubsteps_));
    }
    int wantedSubsteps() const { return (quietSubsteps() + parts_ - 1) / parts_ * parts_; }
    const ode::MethodInfo& method() const { return *methodsOf(plan_.solver).find(plan_.solver.integrator); }
    void visitPlan(StateBytes& bytes);
    void visitInside(StateBytes& bytes);
    void visitSleep(StateBytes& bytes);
    void visitStep(StateBytes& bytes);

    // Members that every tick reads stand close together.
    std::unique_ptr<Dynamics> dynamics_;
    bool isOpen_ = false;              // v is at the time of x, and the method has not started from there yet
    bool mayCollide_ = false;          // there are colliders, and bodies that collide with them
    bool mayFreeze_ = false;           // after a fault
    bool hasCells_ = false;            // to watch
    bool hasMoved_ = false;            // any tick yet
    bool hasLooked_ = false;           // for points that stand inside colliders
    bool isChanged_ = false;           // the plan is not as it was built
    bool haveForcesJumped_ = false;    // since the island was opened
    Changes changes_;                  // of the plan, which the dynamics have not taken over yet
    bool shortensForContact_ = false;  // contact may shorten the step
    StepChoice choice_;
    double tickSeconds_;      // [s]
    bool keepsStep_ = false;  // no state changes the step
    int quietParts_ = 1;      // parts of a tick, into which substeps are divided while nothing presses it
    int parts_ = 1;           // the same, for the present tick
    int ownSubsteps_ = 1;     // substeps a tick, where they do not follow the state
    IslandPlan plan_;
    ForceList forces_;
    ode::Work workElsewhere_;  // of runs before it was read, less the work of mere queries
    std::vector<dvec3> x_;     // (points) scratch
    collision::Colliders colliders_;
    IslandMemory now_, before_;  // the present state, and that at the start of the tick
    struct {
        int rescues = 0;        // so far, of a tick that diverges
        int doublings = 0;      // of steps, for contact to add less
        double addedFirst = 0;  // [J] by contact, before these doublings
    } tries_;                   // of this tick
    std::vector<std::string> insideWarnings_;
    std::string stretchWarning_, collapseWarning_, limitWarning_;
    PrecisionWatch precision_;
    Yielding yielding_;
    TieLoad tieLoad_;
    std::optional<FrozenIsland> frozen_;
    RestWatch rest_;
    struct {
        std::int64_t company = 0;
        Slept taken;
        // Made when they are asked for:
        std::optional<core::Aabb> box;  // [m] of the points
        std::vector<std::pair<const Body*, std::uint64_t>> hashes;
    } sleep_;
};

}  // namespace taut::world
