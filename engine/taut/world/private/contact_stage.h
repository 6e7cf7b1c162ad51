// The contact stage of a tick: all islands with bodies that may touch go through the tick together, from one instant of
// contact to the next. Between two instants each island takes its own substeps and knows nothing of the others; at an
// instant the ContactGroup keeps surfaces from going through each other.
//
//     tick    |-----------|-----------|-----------|-----------|       4 instants
//     island  |---|---|---|---|---|---|---|---|---|---|---|---|       12 substeps: a multiple of the instants
//
// How many instants. As few as will do, for an instant costs a detection:
// - Nothing is forecast to touch: a trial with few, often one. It stands only if no pair got an impulse.
// - Something is: at least one per 1.1 ms; so many that what touches follows the islands' own motion (instantsToPress);
//   and so many that two sides close by no more than 0.35 of their thickness in one.
// - An instant turns out too coarse: a trial found contact, a pair went too deep, or pairs had to be slid apart. The
//   whole tick is undone then, and repeated with at least twice as many, up to 64.
// A tick is also repeated when an island asks for it (its step was too long), and when one diverged and is frozen: the
// others then go on beside it as it stands. Islands keep what they need to go back in beginTry().
//
// Deterministic. Each choice is a function of the state at the start of the tick and of what the tries found, and an
// instant depends on its places and velocities alone (contact_group.h). No clock, thread or list age has a say; wall
// time is measured for reports only.
//
// Restorable. All that outlives a tick is saved by its owner: the islands' states, and the pace, the number of substeps
// that all islands' steps are multiples of. The stage itself saves nothing. It is made anew when a body comes or goes,
// or a world is restored, and goes on with the same bits.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "taut/contact/contact_group.h"
#include "taut/island/private/island.h"
#include "taut/spec/spec.h"
#include "taut/world/private/collider_surfaces.h"
#include "taut/world/contact_info.h"

namespace taut::world {

// The least number of instants in a tick in which bodies touch.
int fewestInstants(double tickSeconds);

// Whether any body of the plan may touch other bodies, itself, or edges of colliders.
bool touches(const IslandPlan& plan);

// The surface of a body. Its points are numbered as in its island, from `offset` on.
contact::ContactSurface surfaceOf(const Body& body, int offset, int bond);

class ContactStage {
  public:
    // Takes the islands with bodies that may touch. Keeps references to them and to `pace`: it follows how many
    // instants are needed, and each island's substeps are a multiple of it. `colliders` is called if any body touches
    // colliders.
    ContactStage(std::span<const std::unique_ptr<Island>> islands, const ContactSpec& spec, double tickSeconds,
                 StepFollowing& pace, const std::function<std::vector<TouchedCollider>()>& colliders);

    bool isEmpty() const { return islands_.empty(); }
    std::span<Island* const> islands() const { return islands_; }

    // One tick of all islands. On a fault of an island that is not to be frozen it ends early, and says which and why.
    struct Outcome {
        Island* island = nullptr;
        Fault fault;
    };
    std::optional<Outcome> tick(const TickTime& time, std::span<const ColliderMotion> moving);

    // Points have been moved from outside.
    void drop() { hasJumped_ = true, areCrossingsKnown_ = false; }

    // Of the last tick.
    int instants() const { return instants_; }
    const contact::InstantResult& result() const { return result_; }
    ContactInfo info() const;
    std::vector<contact::ContactPoint> contacts() const;         // at its end
    std::span<const contact::Crossing> crossingsBefore() const;  // at its start
    bool hadImpulse() const { return hadImpulse_; }        // a pair had an impulse, in any tick
    const std::vector<contact::Crossing>& crossings();           // now
    dvec3 position(int point) const {
        return x1_[static_cast<std::size_t>(point)];
    }  // [m] when the last of these was called
    const contact::Elements& elements() const { return group_->elements(); }
    // The body of a surface. Surfaces of bodies come first, then those of colliders.
    const Body& bodyOf(int surface) const { return *bodies_[static_cast<std::size_t>(surface)]; }
    bool isOfBody(int surface) const { return surface < static_cast<int>(bodies_.size()); }
    // [m] How far edges of colliders stand out of triangles of wanted bodies, between two ticks: see penetrationOf().
    double facePenetration(const std::function<bool(const Body&)>& wanted);

  private:
    // An island's range of the group's points.
    struct Part {
        Island* island;
        int first, last;  // points of the group
    };
    void beginTick(const TickTime& time, std::span<const ColliderMotion> moving);
    void takeDamage();
    void readAll();
    int mostInstants() const;
    int commonSubsteps() const;  // greatest common divisor of the islands; 1 where all are frozen
    bool movesAny() const;
    int instantsFor(std::span<const int> surfaces) const;
    int chooseInstants(const TickTime& time);
    int takeInstants(const TickTime& time, int needed);
    void resolveInstant(double h);
    void settle();
    bool findFaults(double t, std::vector<std::optional<Fault>>& faults) const;
    void reportAccelerations();
    bool isTooCoarse(bool isTrial) const;
    bool tryTick(const TickTime& time, std::span<const ColliderMotion> moving, int instants,
                 std::vector<std::optional<Fault>>& faults, bool isTrial);

    ContactSpec spec_;
    double tickSeconds_;
    int fewest_;  // instants of a tick in which anything touches
    StepFollowing& pace_;
    std::vector<Island*> islands_;
    std::vector<Part> parts_;          // (islands)
    std::vector<const Body*> bodies_;  // (surfaces)
    std::vector<std::size_t> damage_;  // (surfaces) severed edges that the elements know of
    ColliderSurfaces colliders_;
    std::unique_ptr<contact::ContactGroup> group_;
    bool hasJumped_ = true;
    bool hadImpulse_ = false;
    bool areCrossingsKnown_ = false;
    std::vector<contact::Crossing> crossings_;
    std::vector<dvec3> x0_, x1_, v_;   // (points)
    std::vector<dvec3> vBefore_;       // (points) before the last instant
    std::vector<double> inverseMass_;  // (points)
    std::vector<contact::KinematicContact> kinematic_;
    int instants_ = 0;
    contact::InstantResult result_;
    ContactInfo total_;  // of the ticks since it was made
};

}  // namespace taut::world
