// The contact stage of a tick: all islands with bodies that may touch go through the tick together, step by step. In
// each step every island moves as if it were alone; then the ContactGroup gives impulses that keep surfaces from going
// through each other. Which surfaces may meet is found once in a block of steps.
//
//     tick    |---------------|---------------|---------------|---------------|    4 blocks: detection, certificate
//             |---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|    16 steps: impulses
//     island  |-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|    32 substeps: a multiple of the steps
//
// How many steps. As many as the stiffest body has that may meet something in this tick, so that an impulse is one more
// force of its step: all islands take substeps that are a multiple of these. And so many that nothing goes by more than
// three thicknesses in one.
//
// How many blocks. As few as possible, because detection is expensive: eight in a sixtieth of a second, or one a step
// if these are fewer. After a block without rows the next one may have four times the usual length, and after a calm
// one in which nothing may roll twice the usual length. A block in which two sides would go further than three
// thicknesses from one another or past is shorter, and it ends with a step in which something bounced.
//
// A tick is never tried and undone for contact. It is repeated if an island asks for it (its step was too long), if one
// diverged and is frozen, and where something that sleeps was reached. The other islands then go on, and the frozen one
// stands still. Islands keep the state to go back to in beginTry().
//
// Deterministic. Each choice is a function of the state at the start of the tick and of the results of the tries. A
// block depends only on its places and velocities (contact_group.h). Clocks and threads have no influence; wall time is
// measured for reports only.
//
// Restorable. All that outlives a tick is saved by its owner: the states of the islands, the forces of contacts, and
// the pace, which is the number of substeps that divides all islands' substeps. The stage itself saves nothing. It is
// made anew when a body comes or goes or a world is restored, and goes on with the same bits.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "taut/bodies/private/carried_surface.h"
#include "taut/contact/contact_group.h"
#include "taut/island/private/island.h"
#include "taut/spec/spec.h"
#include "taut/world/contact_info.h"
#include "taut/world/private/collider_surfaces.h"
#include "taut/world/private/element_contacts.h"
#include "taut/world/private/rigid_contacts.h"

namespace taut::world {

// The smallest number of steps in a tick of deformable bodies that touch.
int fewestSteps(double tickSeconds);

// Whether any body of the plan may touch other bodies, itself, or edges of colliders.
bool touches(const IslandPlan& plan);

// One of surfacesOf(body). Its points have their island numbers plus `offset`.
contact::ContactSurface surfaceOf(const Body& body, const mechanics::RigidPart& part, int offset, int bond);

// Replaces the surface of a body by its carried surface, whose points are appended to `rest`. numberOf(point of the
// model): its number in `rest`.
void carry(const CarriedSurface& own, const std::function<int(int)>& numberOf, contact::ContactSurface& surface,
           std::vector<dvec3>& rest, std::vector<contact::CarriedPoint>& carried);

class ContactStage {
  public:
    // Takes the islands with bodies that may touch. Keeps references to them, to `pace` and to `kept`. The pace follows
    // the number of steps needed, and each island's substeps are a multiple of it. The kept forces are those with which
    // contacts pressed as the last tick ended. Calls `colliders` if any body touches
    // colliders.
    ContactStage(std::span<const std::unique_ptr<Island>> islands, const ContactSpec& spec, const TickTime& now,
                 StepFollowing& pace, std::vector<contact::KeptForce>& kept,
                 const std::function<std::vector<TouchedCollider>()>& colliders);

    bool isEmpty() const { return islands_.empty(); }
    std::span<Island* const> islands() const { return islands_; }

    // Takes one tick of all islands. A fault of an island that may not freeze ends it early; the outcome says which and
    // why.
    struct Outcome {
        Island* island = nullptr;
        Fault fault;
    };
    // watchesFriction: for supports(), footholds() and pressing(), which tell of this tick.
    std::optional<Outcome> tick(const TickTime& time, std::span<const ColliderMotion> moving, bool watchesFriction);

    // Sleep. All islands are still, and some sleep: a tick does nothing.
    bool isAtRest() const { return anySleeps() && !movesAny() && !colliders_.hasFigures(); }
    // (points of the island) by other bodies, and by edges of colliders. Friction may hold a point if it used at most
    // 0.9 of Coulomb's limit.
    std::vector<Island::Support> supports(const Island& island) const;
    // Where a solid was pressed, by island.
    using Footholds = std::map<const Island*, std::vector<Island::Foothold>>;
    const Footholds& footholds() const { return footholds_; }
    // Islands that pressed each other, each two once.
    std::span<const std::pair<const Island*, const Island*>> pressing() const { return pressing_; }
    // Whether anything of the island crossed, or was crossed by, anything at the start of the last tick.
    bool crosses(const Island& island) const;

    // To be called when points have been moved from outside.
    void drop() { hasJumped_ = true, areCrossingsKnown_ = false; }

    const contact::BlockResult& result() const { return group_->result(); }  // of the last block
    ContactInfo info() const;
    std::vector<int> squeezed() const;  // points of the group that were squeezed in its last block
    // At its end; of whole bodies with colliders too, whose other side is noSurface.
    static constexpr int noSurface = -1;
    std::vector<contact::ContactPoint> contacts() const;
    std::span<const contact::Crossing> crossingsBefore() const;  // at its start
    bool hadImpulse() const { return hadImpulse_; }              // whether any pair had an impulse, in any tick
    const std::vector<contact::Crossing>& crossings();           // at present
    dvec3 position(int point) const {
        return x1_[static_cast<std::size_t>(point)];
    }  // [m] after the last tick or crossings()
    const contact::Elements& elements() const { return group_->elements(); }
    // The body of a surface. Surfaces of bodies come before those of colliders.
    const Body& bodyOf(int surface) const { return *bodies_[static_cast<std::size_t>(surface)]; }
    bool isOfBody(int surface) const { return surface >= 0 && surface < static_cast<int>(bodies_.size()); }
    // "cloth.flag", "collider.pole".
    std::string nameOf(int surface) const {
        return isOfBody(surface) ? bodyOf(surface).fullName() : colliders_.nameOf(surface);
    }
    const std::string& colliderName(int collider) const { return colliderNames_[static_cast<std::size_t>(collider)]; }
    // Of the last block.
    std::span<const ElementTouch> elementTouches() const { return elementTouches_; }
    // The surfaces of a crossing: two of bodies in their order, or of a body and then of a figure; none: an edge of a
    // rigid collider sticks out of a face, which is no crossing.
    std::optional<std::pair<int, int>> sidesOf(const contact::Crossing& crossing) const;
    double depthOf(
        const contact::Crossing& crossing) const;  // [m] of the edge's closer end behind the triangle's plane
    // How far colliders stick out of triangles of wanted bodies, between two ticks: edges of rigid ones as
    // penetrationOf() measures it, and figures as depthOf() does.
    struct Penetration {
        double ofPoints = 0;      // [m] of bodies that meet colliders as a whole; else their islands know
        double deepest = 0;       // [m]
        int figureCrossings = 0;  // edges of bodies through figures, or the other way round
    };
    Penetration penetration(const std::function<bool(const Body&)>& wanted);
    // Places of convex solids that are further in each other than they are rounded, between two ticks.
    std::vector<RigidTouch> overlaps();

  private:
    // The range of an island in the group's points.
    struct Part {
        Island* island;
        int first, last;  // points of the group
    };
    void keepJoinedApart(std::span<const int> offsets, std::span<const TouchedCollider> touched, double t);
    void addPivot(const Part& part, std::size_t tie, std::span<const TouchedCollider> touched);
    void beginTick(const TickTime& time, std::span<const ColliderMotion> moving);
    void takeDamage();
    void takeMasses();
    void takeSolids();
    void addPiece(const Body& body, contact::ContactSurface& surface, int offset);
    void addWholeContacts(double h, double ahead);
    bool isHeldIn(const Body& body, int collider) const;
    bool mayMeet(int surface, int collider) const;
    void findTouches(std::span<const dvec3> x0, std::span<const dvec3> x1, double from, double to,
                     bool alsoOfStill = false);
    void findPresentTouches();
    void addTouches();
    void addJoints(double t);
    void placePivots(double t);
    bool isAtPivot(int surface, int other, int collider, const dvec3& place, double reach) const;
    bool addJoint(const Part& part, const HeldPair& pair, double t, int name);
    template <class Each>
    void forEachNearCollider(double past, double ahead, const Each& each,
                             const std::function<bool(int surface)>& isWanted = nullptr) const;
    void wake(const TickTime& time, std::span<const std::int64_t> companies);
    void wakeCrossed(const TickTime& time);
    void addReached(int surfaceA, int surfaceB);
    bool findReached();
    void addPresses();
    void addFootholds();
    bool anySleeps() const;
    void readAll();
    bool bounces(const Island& island) const;
    int mostSteps() const;
    int commonSubsteps() const;  // greatest common divisor over the islands; 1 if all are frozen
    bool movesAny() const;
    bool isNearAny(int surface, std::span<const core::Aabb> boxes) const;
    void chooseSteps(const TickTime& time);
    void takeSteps(const TickTime& time, int steps);
    void takeBlocks(const TickTime& time, std::span<const ColliderMotion> moving,
                    std::vector<std::optional<Fault>>& faults);
    bool advance(const TickTime& time, std::span<const ColliderMotion> moving, int first, int last,
                 std::vector<std::optional<Fault>>& faults);
    void findWays(double h);
    int nextLength(int steps, int usual) const;
    double mostWayOfPair() const;
    int openBlock(const TickTime& time, int step, int steps, int usual);
    bool mayRoll() const;
    void closeBlock();
    void place(std::span<const int> points);
    bool settle();
    bool findFaults(double t, std::vector<std::optional<Fault>>& faults) const;
    void takeAccelerations();
    void reportAccelerations();

    ContactSpec spec_;
    double tickSeconds_;
    int fewest_;  // fewestSteps()
    StepFollowing& pace_;
    std::vector<contact::KeptForce>& keptForces_;
    std::vector<Island*> islands_;
    std::vector<Part> parts_;               // (islands)
    std::vector<const Body*> bodies_;       // (surfaces)
    std::vector<std::vector<int>> solids_;  // their points in the group, ascending
    std::vector<int> solidOf_;              // (points) which; -1: none
    struct Whole {
        int surface;
        double thickness;         // [m] without its sag
        std::vector<int> points;  // of the surface, those that are near each other together
    };
    std::vector<Whole> wholes_;  // of bodies that meet colliders as a whole
    // Where a joint holds two solids, or a solid and a collider, whose sides touch each other.
    struct Pivot {
        int solid, other, collider;  // -1: none
        const Part* part;
        std::size_t tie;          // of its plan
        std::array<dvec3, 2> at;  // [m] pins of it, as the block begins: one, or two on an axle
        int pins;
    };
    std::vector<Pivot> pivots_;
    // Surfaces and numbers of colliders that carry points of them: they do not touch.
    std::set<std::pair<int, int>> mountedOn_;
    std::vector<std::size_t> damage_;  // (surfaces) number of severed edges taken into the elements
    ColliderSurfaces colliders_;
    ConvexColliders convex_;
    RigidContacts rigid_;
    ElementContacts ofElements_;
    std::vector<ShapeInMotion> shapes_;  // of convex colliders, in the last block
    std::span<const RigidTouch> rigidTouches_;
    std::span<const ElementTouch> elementTouches_;
    std::vector<collision::Material> materials_;  // (colliders)
    std::vector<std::string> colliderNames_;      // (colliders)
    std::unique_ptr<contact::ContactGroup> group_;
    bool hasJumped_ = true;
    bool hadImpulse_ = false;
    bool areCrossingsKnown_ = false;
    std::vector<contact::Crossing> crossings_;
    std::vector<dvec3> x0_, x1_, v_;            // (points)
    std::vector<dvec3> xStart_, ahead_;         // (points) [m] at the start of the block; where it may lead
    std::vector<dvec3> ways_;                   // (points) [m] of a step of the block, as it begins
    std::vector<dvec3> vStart_, vBefore_;       // (points) as the last step began; before contact in it
    std::vector<ContactAcceleration> pressed_;  // (moved points of the group) in the last step
    std::vector<double> inverseMass_;           // (points)
    std::vector<contact::KinematicContact> kinematic_;
    std::vector<contact::ContactConstraint> rigidPairs_;
    // Impulses of contact on a point in a tick, summed over pairs and steps.
    struct Press {
        double limit = 0;                // [N s] of friction
        dvec3 push{0.0}, friction{0.0};  // [N s] along the normals, and across
    };
    std::vector<Press> presses_;                                     // (points) empty: nobody asked
    std::vector<std::pair<const Island*, const Island*>> pressing_;  // likewise
    Footholds footholds_;                                            // likewise
    std::vector<std::int64_t> reached_;                              // companies, in this try
    double weight_ = 0;           // [m/s²] largest acceleration by uniform fields, at the start of the tick
    int blocks_ = 1, steps_ = 1;  // of this tick
    int room_ = 1;                // steps for which the substeps of this tick have room
    int mostBlocks_ = 0;          // in any tick
    ContactInfo total_;           // sum over the ticks since it was made
};

}  // namespace taut::world
