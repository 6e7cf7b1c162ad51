// Bodies that touch each other, or themselves: their islands go through a tick together, from one instant of contact to
// the next. It is made anew when a body comes or goes, and knows nothing that the islands do not.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "taut/contact/contact_group.h"
#include "taut/island/island.h"
#include "taut/spec/spec.h"
#include "taut/world/collider_surfaces.h"
#include "taut/world/contact_info.h"

namespace taut::world {

// Instants of a tick in which bodies touch, at least.
int fewestInstants(double tickSeconds);

// Whether any body of the plan touches anything.
bool touches(const IslandPlan& plan);

// The surface of a body, its points numbered from `offset` on as in its island.
contact::Surface surfaceOf(const Body& body, int offset, int bond);

class ContactStage {
  public:
    // Of the islands with bodies that touch; expects that they stay, and `pace` too, which follows what presses: the
    // parts that all substeps of a tick can be divided into. Colliders are asked for if any body meets them.
    ContactStage(std::span<const std::unique_ptr<Island>> islands, const ContactSpec& spec, double tickSeconds,
                 StepFollowing& pace, const std::function<std::vector<TouchedCollider>()>& colliders);

    bool isEmpty() const { return islands_.empty(); }
    std::span<Island* const> islands() const { return islands_; }

    // A tick of all of them. On a fault that is not to be frozen it ends early and says whose it was.
    struct Outcome {
        Island* island = nullptr;
        Fault fault;
    };
    std::optional<Outcome> tick(const TickTime& time, std::span<const ColliderMotion> moving);

    // Points have been put elsewhere than ticks led them.
    void drop() { hasJumped_ = true, areCrossingsKnown_ = false; }

    // What the last tick was like.
    int instants() const { return instants_; }
    const contact::InstantResult& result() const { return result_; }
    ContactInfo info() const;
    std::vector<contact::ContactPoint> contacts() const;         // at its end
    std::span<const contact::Crossing> crossingsBefore() const;  // at its start
    bool hasMet() const { return hasMet_; }                      // anything has pressed, in any tick
    const std::vector<contact::Crossing>& crossings();           // now
    dvec3 position(int point) const { return x1_[static_cast<std::size_t>(point)]; }  // [m] as the last of those saw it
    const contact::Elements& elements() const { return group_->elements(); }
    // Of the surface of a body; those of colliders come after them, and are rigid.
    const Body& bodyOf(int surface) const { return *bodies_[static_cast<std::size_t>(surface)]; }
    bool isOfBody(int surface) const { return surface < static_cast<int>(bodies_.size()); }
    // How far colliders stand out of triangles of those bodies, between two ticks [m]: contact::penetrationOf().
    double facePenetration(const std::function<bool(const Body&)>& wanted);

  private:
    struct Part {
        Island* island;
        int first, last;  // points of the group
    };
    void takeDamage();
    void readAll();
    int mostInstants() const;
    int commonSubsteps() const;  // 1 where all are frozen
    bool movesAny() const;
    int instantsFor(std::span<const int> surfaces) const;
    int chooseInstants(const TickTime& time);
    int takeInstants(const TickTime& time, int needed);
    void meet(double h);
    void settle();
    bool findFaults(double t, std::vector<std::optional<Fault>>& faults) const;
    void bear();
    bool isTooCoarse(bool isTrial) const;
    bool tryTick(const TickTime& time, std::span<const ColliderMotion> moving, int instants,
                 std::vector<std::optional<Fault>>& faults, bool isTrial);

    ContactSpec spec_;
    double tickSeconds_;
    int fewest_;  // instants of a tick in which anything touches
    StepFollowing& pace_;
    std::vector<Island*> islands_;
    std::vector<Part> rooms_;          // (islands)
    std::vector<const Body*> bodies_;  // (surfaces)
    std::vector<std::size_t> damage_;  // (surfaces) severed edges that are known
    ColliderSurfaces rigids_;
    std::unique_ptr<contact::ContactGroup> group_;
    bool hasJumped_ = true;
    bool hasMet_ = false;
    bool areCrossingsKnown_ = false;
    std::vector<contact::Crossing> crossings_;
    std::vector<dvec3> x0_, x1_, v_;   // (points)
    std::vector<dvec3> vBefore_;       // (points) of the last instant's contact
    std::vector<double> inverseMass_;  // (points)
    std::vector<contact::KinematicContact> held_;
    int instants_ = 0;
    contact::InstantResult result_;
    ContactInfo total_;  // of the ticks since it was made
};

}  // namespace taut::world
