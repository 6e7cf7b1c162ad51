// One island: the bodies that move together, how they are doing, and what is done to them. island_report.h tells of it.
//
//   island.cpp          ticks, and what is changed between two ticks
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
#include "taut/core/private/hash.h"
#include "taut/island/private/dynamics.h"
#include "taut/island/private/envelope.h"
#include "taut/island/private/memory.h"
#include "taut/island/private/precision_watch.h"
#include "taut/island/report.h"
#include "taut/island/private/step_choice.h"
#include "taut/island/private/step_following.h"
#include "taut/island/private/tie_load.h"
#include "taut/island/private/yielding.h"

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
    int point = -1;           // in the island
    double time = 0;          // [s]
    bool isNumber = true;     // false: NaN or infinite
    bool byContact = false;   // with other bodies, which was the last that moved it
    bool isTooStiff = false;  // for a million steps a tick
    double strain = 0;        // above 0: of a spring at the point, over the one at which to freeze
};

// The way of a moving collider during a tick.
struct ColliderMotion {
    int collider = 0;
    collision::Pose from, to;
};

// What becomes of a try of a tick.
enum class TickVerdict { stands, again, fails };

// [rad] ω H of the fastest motion of what presses, H the time from one instant of contact to the next. At an instant a
// step each (2 is the limit of leap-frog) an impulse is one more force of the step's kick, and contact without
// restitution takes energy: ΔE = ½ λ (u' + u), u' and u the approach after it and in the step before, never above 0.
// What is moved back over several steps is moved against its springs: at ω H = 3 they gain several times ½ m u².
inline constexpr double longestTurn = 2.0;

class Island {
  public:
    // At time t [s]. Chooses its step, which holds for all that the envelope allows; throws core::Error(badContent)
    // where no step would do.
    // With `keepsStep` no state changes it. All substeps of a tick can be divided into `parts`, a power of two; fewer
    // are a power of two.
    Island(IslandPlan plan, const ForceList& forces, const Envelope& envelope, double ticksPerSecond, double t,
           bool keepsStep, int parts = 1);
    Island(const Island&) = delete;
    Island& operator=(const Island&) = delete;

    // Each island has colliders of its own: with other substeps they are elsewhere. The first time it looks which of
    // its points stand inside; names (colliders): "collider.ground", …
    void setColliders(collision::Colliders colliders, std::span<const std::string> names);

    // substeps steps of leap-frog or whichever method; contacts of the last step are kept. Ends early on a fault.
    // Expects that the island is not open.
    std::optional<Fault> tick(const TickTime& time, std::span<const ColliderMotion> moving);

    // A tick in pieces, of islands whose bodies touch others: beginTick(), then tries until one stands. A try begins,
    // goes on by parts of all substeps, and is judged; after `again` the island begins another from where the tick
    // began, and may be asked to for the sake of others.
    void beginTick(const TickTime& time);
    void beginTry();
    std::optional<Fault> advance(const TickTime& time, std::span<const ColliderMotion> moving, int part, int parts);
    TickVerdict judge(const TickTime& time, std::optional<Fault>& fault);
    void tryAgain(const TickTime& time, TickVerdict verdict);
    void endTick(const TickTime& time);
    int substeps() const { return now_.substeps; }
    bool keepsStep() const { return keepsStep_; }
    // Instants of a tick in which something presses it: one a step, or where steps are shorter than that, as many as
    // turn its fastest motion by no more than longestTurn.
    int instantsToPress() const;
    // All substeps of a tick can be divided into so many parts from now on; to be called between two tries.
    void takeParts(const TickTime& time, int parts);
    // Where points of the island are, and velocities as the method stores them (points) [m], [m/s].
    void read(std::span<dvec3> x, std::span<dvec3> v) const;
    // After a part: points (ascending) were moved by contact with other bodies; out of colliders again.
    void place(std::span<const int> points, std::span<dvec3> x, std::span<dvec3> v);
    // After those: constraints share what it changed. Whether any of its points went elsewhere.
    bool settle() { return !frozen_ && dynamics_->settle(); }
    // After the last part: what contact with other bodies gave points in the last instant.
    void bear(std::span<const ContactAcceleration> pressed) { now_.pressed.assign(pressed.begin(), pressed.end()); }

    // Whether any spring tore in the last tick.
    bool hasTorn() const { return yielding_.hasTorn(); }

    // (ties of joints) whether the mean of the force through it over the last tick was above what it bears.
    std::vector<bool> overloaded() const;

    // Puts back what the last tick began with.
    void undoTick();

    // After a fault: back to the state before the step that failed, where it stays; its ticks do nothing any more.
    void freeze(const Fault& fault, const TickTime& time);
    // What became of it, or null while it moves.
    const FrozenIsland* frozen() const { return frozen_ ? &*frozen_ : nullptr; }

    // Changes between two ticks. The first of them opens the island: its velocities are brought to the time of the
    // positions. close() starts the method again from there, on what the plan and the forces have become. A frozen
    // island is not to be changed.
    void open(const TickTime& time);
    void close(const TickTime& time);
    bool isOpen() const { return isOpen_; }
    // Opens; what is said may be changed of the plan. Points and springs stay as many and between the same points.
    IslandPlan& change(const TickTime& time, Change what);
    // Opens; adds to the velocity of points [m/s].
    void push(const TickTime& time, std::span<const int> points, const dvec3& velocity);
    // Opens; the points stand still.
    void stop(const TickTime& time, std::span<const int> points);
    // The way of a hand from now on; opens if `bends`. Does nothing where the hand has hold of nothing.
    void lead(const TickTime& time, const std::string& hand, const mechanics::PosePath& path, bool bends);
    // The same of a collider, "collider.pole"; opens where the way does not go on from the one before.
    void carry(const TickTime& time, const std::string& collider, const mechanics::PosePath& path);
    // Opens where ties of joints that are wanted hold; they let go.
    void release(const TickTime& time, const std::function<bool(const JointTie&)>& wanted);
    // Opens where a force jumps; not if flows and gravity only go on changing.
    void setForces(const TickTime& time, const ForceList& forces);

    // Whether a force that acts here is a callback: such islands go one after another.
    bool callsBack() const { return dynamics_->callsBack(forces_); }

    const IslandPlan& plan() const { return plan_; }
    double step() const { return now_.step; }  // [s]
    dvec3 position(int point) const { return dynamics_->position(point); }
    std::span<const collision::Contact> contacts() const { return now_.contacts; }
    bool hasTouched() const { return now_.hasTouched; }  // anything, at any step so far
    // (points) [m/s] at the time of the tick; zero when frozen. May cost an evaluation.
    std::vector<dvec3> velocities(const TickTime& time);

    // x and the stored v of a body's points in the order of authoring.
    void addToHash(const Body& body, core::Hash& hash) const { dynamics_->addToHash(body.pointOf, hash); }
    // The same of one point.
    void addPointToHash(int point, core::Hash& hash) const { dynamics_->addToHash({&point, 1}, hash); }
    // Since the start.
    ode::Work work() const;
    // Why its step will end the run, with file, line and remedy; empty where it will not.
    const std::string& fault() const { return choice_.fault; }

    // For island_report.h.
    const Dynamics& dynamics() const { return *dynamics_; }
    Dynamics& dynamics() { return *dynamics_; }
    const IslandMemory& memory() const { return now_; }
    StepChoice choice() const;  // with the steps that there are now
    const collision::Colliders& colliders() const { return colliders_; }
    // The product with its stiffness at these places of its points, which have to stay.
    mechanics::StiffnessProduct stiffnessAt(std::span<const dvec3> x) const;
    bool hasMoved() const { return hasMoved_; }  // any tick yet
    std::vector<std::string> said() const;       // warnings so far that cannot be derived

    // All that changes while it moves, written or read. Throws core::Error(badContent) for bytes that do not fit.
    void visit(StateBytes& bytes);

  private:
    std::optional<Fault> takeSubsteps(const TickTime& time, std::span<const ColliderMotion> moving, int first,
                                      int last);
    TickVerdict judgeSteps(const TickTime& time, std::optional<Fault>& fault);
    // From velocities at the time of the positions.
    void startWith(const TickTime& time, int substeps, bool isRepeated);
    std::optional<Fault> overstrained(double t);
    Fault giveUp(double t) const;
    void findInside(std::span<const std::string> names);
    void moveColliders(std::span<const ColliderMotion> moving, int substep);
    void watchVolumes(double t);
    void watchLimit(double t);
    void setPath(std::size_t grip, const mechanics::PosePath& path);
    bool addsTooMuch(const ContactWork& work) const;
    int inParts(int substeps) const;
    int quietSubsteps() const {  // where nothing presses it
        return inParts(now_.budget.factor * (choice_.need ? now_.following.substeps() : ownSubsteps_));
    }
    int wantedSubsteps() const { return (quietSubsteps() + parts_ - 1) / parts_ * parts_; }
    const ode::MethodInfo& method() const { return *methodsOf(plan_.solver).find(plan_.solver.integrator); }
    void visitPlan(StateBytes& bytes);
    void visitInside(StateBytes& bytes);
    void visitStep(StateBytes& bytes);

    // What every tick looks at stands close together.
    std::unique_ptr<Dynamics> dynamics_;
    bool isOpen_ = false;              // v is at the time of x, and the method not started from there
    bool mayCollide_ = false;          // there are colliders, and bodies for them
    bool mayFreeze_ = false;           // after a fault
    bool hasCells_ = false;            // to watch
    bool hasMoved_ = false;            // any tick yet
    bool hasLooked_ = false;           // which points stand inside colliders
    bool isChanged_ = false;           // the plan is not as it was built
    bool haveForcesJumped_ = false;    // since the island was opened
    Changes changes_;                  // of the plan, that the dynamics know nothing of yet
    bool shortensForContact_ = false;  // the step
    StepChoice choice_;
    double tickSeconds_;      // [s]
    bool keepsStep_ = false;  // whatever the state is
    int quietParts_ = 1;      // a tick, that substeps are to be divided into while nothing presses it
    int parts_ = 1;           // likewise, now
    int ownSubsteps_ = 1;     // a tick, where they do not follow the state
    IslandPlan plan_;
    ForceList forces_;
    ode::Work workElsewhere_;  // of what ran before it was read, less that of what was only asked
    std::vector<dvec3> x_;     // (points) scratch
    collision::Colliders colliders_;
    IslandMemory now_, before_;  // as it is, and what the tick began with
    struct {
        int rescues = 0;        // so far, of a tick that diverges
        int doublings = 0;      // of steps, for contact to add less
        double addedFirst = 0;  // [J] by contact, before those
    } tries_;                   // of this tick
    std::vector<std::string> insideWarnings_;
    std::string stretchWarning_, collapseWarning_, limitWarning_;
    PrecisionWatch precision_;
    Yielding yielding_;
    TieLoad tieLoad_;
    std::optional<FrozenIsland> frozen_;
};

}  // namespace taut::world
