// The moving points of one island: its system, state and method. The interface is in double precision,
// also if the island computes in single precision. It knows no tick and no reason why a plan changes.
#pragma once

#include <bitset>
#include <memory>
#include <span>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/core/private/hash.h"
#include "taut/forces/force.h"
#include "taut/mechanics/private/spring_watch.h"
#include "taut/mechanics/private/state_bound.h"
#include "taut/mechanics/private/volume.h"
#include "taut/ode/method.h"
#include "taut/plan/held_pair.h"
#include "taut/plan/state_bytes.h"

namespace taut::world {

struct IslandInfo;

// Which part of a plan changes.
enum class Change {
    lengths,   // rest lengths of springs
    material,  // springs, drag, bulk moduli of cells
    points,    // masses, drag, held points
    grips,     // their number, and their holders
    damage,    // springs, cells and triangles that are gone
    shape,     // damage and constraints
    count
};
class Changes : public std::bitset<static_cast<std::size_t>(Change::count)> {
  public:
    bool has(Change change) const { return test(static_cast<std::size_t>(change)); }
    Changes& add(Change change) {
        set(static_cast<std::size_t>(change));
        return *this;
    }
};

enum class Since { tick, step };

// How contacts have changed the energy of an island.
struct ContactWork {
    double added = 0;    // [J]
    double atTouch = 0;  // [J] kinetic, elastic and of height over the lowest point, at a tick's first touch; or 0
};

// The acceleration that contact with other bodies gave a point in the last step.
struct ContactAcceleration {
    int point;
    dvec3 acceleration;  // [m/s²] mean over the step
};

// Speed of points on their way out of a collider in which they began. [m/s]
inline constexpr double emergingSpeed = 1.0;

class Dynamics {
  public:
    virtual ~Dynamics() = default;

    // Takes over these changes of the plan, in place. Expects as many points and springs as before, in the same order.
    virtual void take(const Changes& changes, const ForceList& forces) = 0;
    // Takes over stiffness and rest length of these springs only. The method goes on.
    virtual void changeSprings(std::span<const int> springs) = 0;
    // Sets the limits to watch, (springs) or for one spring that already had some.
    virtual void watchLengths(std::span<const mechanics::LengthLimits> limits) = 0;
    virtual void watchLength(int spring, const mechanics::LengthLimits& limits) = 0;
    // Appends the springs that are beyond their limits.
    virtual void findBeyond(std::vector<int>& springs) const = 0;
    // Makes the generators of all forces anew.
    virtual void setForces(const ForceList& forces) = 0;
    // Whether any force that acts here is a callback.
    virtual bool callsBack(const ForceList& forces) const = 0;
    // Whether every force that acts here is steady.
    virtual bool isSteady(const ForceList& forces) const = 0;
    // Takes over forces that go on without a jump from those before.
    virtual void steer(const ForceList& forces) = 0;
    // Takes over the changed path of a grip.
    virtual void leadGrip(std::size_t grip) = 0;

    // Whether the method splits the dashpots off. To be called before start().
    virtual void split(bool splits) = 0;
    // Starts the method from positions and velocities at t [s], with steps of h [s].
    virtual void start(double t, double h) = 0;
    virtual void step(double t) = 0;
    // Brings the points that collide out of the colliders. Expects that rememberPositions() was called before the step.
    // Returns whether it touched any point. Appends the contacts to `contacts`, if given.
    virtual void rememberPositions() = 0;
    virtual bool collide(const collision::Colliders& colliders, std::vector<collision::Contact>* contacts) = 0;
    // After collide(): points that began inside a collider move out no faster than emergingSpeed. Points that are out
    // leave the list.
    virtual void emerge(const collision::Colliders& colliders, std::vector<int>& inside) = 0;
    // After contact with other bodies, between two steps: moves points (ascending) to x [m] with velocities v [m/s] as
    // the method stores them. Colliders may stop points on the way. Writes the result back to x and v.
    virtual void place(const collision::Colliders* colliders, std::span<const int> points, std::span<dvec3> x,
                       std::span<dvec3> v) = 0;
    // After any contact and before any other question: constraints share its changes. Returns whether there were any.
    virtual bool settle() = 0;
    // The largest |l - L|/L of ties of constraints whose points count, at t [s].
    virtual double strain(double t, const std::vector<bool>& only) = 0;
    // [N s] The impulse of ties of constraints since forgetImpulses(). turning(): the share of these impulses, over so
    // many seconds up to t [s], in ω² [1/s²].
    virtual void forgetImpulses() = 0;
    virtual dvec3 impulse(const JointTie::Part& part) const = 0;
    virtual double turning(double t, double seconds) = 0;
    // Pairs that constraints hold at t [s]; until the next call.
    virtual std::span<const HeldPair> heldPairs(double t) = 0;
    // Whether collide() sums up how it changes the energy. takeContactWork() returns that sum and resets it.
    virtual void watchContacts(bool isOn) = 0;
    virtual ContactWork takeContactWork() = 0;
    // The acceleration of uniform fields [m/s²].
    virtual dvec3 gravity(double t) const = 0;
    // The speed [m/s] along an axis below which rounding keeps a point at `place` on it; 0 in double precision.
    virtual double freezingSpeed(double place) const = 0;
    // To be called after every tick of `seconds` where that speed matters. Of the points stuck along an axis, returns
    // the one whose velocity should have moved it furthest since; -1 if none should have moved by more than `most` [m].
    struct Lost {
        int point = -1, plane = 0;
    };
    virtual Lost lost(double seconds, double most) = 0;
    // Keeps the state, to go back to: at the start of a tick or of a step.
    virtual void keep(Since moment) = 0;
    virtual void goBack(Since moment) = 0;
    // Sets the length of the coming steps, for a state that was read.
    virtual void setStep(double h) = 0;
    // The bounds of springs and cells in their present shape.
    virtual mechanics::FastestNow fastestNow() = 0;
    virtual ode::Work work() const = 0;  // since the island was made or read

    // velocities(): as the method stores them. velocitiesAt(): at t [s], which may cost an evaluation. synchronise():
    // stores those at t. Contacts with colliders at t remove, point by point, the velocity into the collider that
    // forces have added since. velocitiesAt(), for reports, also adds the pressure of other bodies. synchronise() does
    // not: its island may be the only one of the two, and impulses conserve momentum only if both sides get them.
    virtual std::vector<dvec3> velocities() const = 0;
    virtual void velocities(std::span<dvec3> v) const = 0;
    virtual std::vector<dvec3> velocitiesAt(double t, std::span<const collision::Contact> contacts,
                                            std::span<const ContactAcceleration> pressed) = 0;
    virtual void synchronise(double t, std::span<const collision::Contact> contacts) = 0;
    virtual void setVelocity(int point, const dvec3& v) = 0;
    // Whether every velocity is a number below the limit; or only those of points that the last collide() touched.
    virtual bool isBounded() const = 0;
    virtual bool isTouchedBounded() const = 0;
    virtual dvec3 position(int point) const = 0;
    virtual void positions(std::vector<dvec3>& x) const = 0;
    virtual void positions(std::span<dvec3> x) const = 0;

    // The share of the generators in the stability bound, at t [s].
    virtual mechanics::StabilityShare stabilityShare(double t) const = 0;
    virtual void addEnergies(double t, const std::vector<bool>& only, double& weight, double& other) const = 0;
    virtual void addStiffnessProduct(std::span<const dvec3> u, std::span<dvec3> out) const = 0;
    // The volumes of the bodies that have cells.
    virtual std::vector<std::pair<const Body*, mechanics::VolumeReport>> volumes(double t, bool stretches) const = 0;

    // Adds x and the stored v of points; of a body also where the friction of its threads holds it.
    virtual void addToHash(std::span<const int> points, core::Hash& hash) const = 0;
    virtual void addToHash(const Body& body, core::Hash& hash) const = 0;
    virtual void visit(StateBytes& bytes) = 0;          // the state
    virtual void describe(IslandInfo& info) const = 0;  // its runs, single springs and bytes
};

// Starts at the plan's positions and velocities, in the precision of its solver. Expects that the plan outlives it.
std::unique_ptr<Dynamics> makeDynamics(const IslandPlan& plan, const ForceList& forces);

}  // namespace taut::world
