// The points of one island in motion: its system, state and method, behind a door that is double whatever the precision
// they were compiled for. It knows no tick, and nothing of why a plan changes.
#pragma once

#include <bitset>
#include <memory>
#include <span>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/core/private/hash.h"
#include "taut/mechanics/private/spring_watch.h"
#include "taut/mechanics/private/state_bound.h"
#include "taut/mechanics/private/volume.h"
#include "taut/ode/method.h"
#include "taut/forces/force.h"
#include "taut/bodies/island_plan.h"
#include "taut/bodies/state_bytes.h"

namespace taut::world {

struct IslandInfo;

// What of a plan a change concerns.
enum class Change {
    lengths,   // rest lengths of springs
    material,  // springs, drag, bulk moduli of cells
    points,    // masses, drag, what is held
    grips,     // how many, and on what
    shape,     // springs, cells and triangles that are gone
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

// What contacts have done to the energy of an island.
struct ContactWork {
    double added = 0;    // [J]
    double atTouch = 0;  // [J] kinetic, elastic, and of the height over the lowest point, at a tick's first touch; or 0
};

// What contact with other bodies gave a point in the last instant.
struct ContactAcceleration {
    int point;
    dvec3 acceleration;  // [m/s²] in the mean of the instant
};

// Of points on their way out of a collider that they began in. [m/s]
inline constexpr double emergingSpeed = 1.0;

class Dynamics {
  public:
    virtual ~Dynamics() = default;

    // Takes over from the plan what has changed of it, in place: points and springs stay as many and where they are.
    virtual void take(const Changes& changes, const ForceList& forces) = 0;
    // Of these springs alone stiffness and rest length, while the method goes on.
    virtual void changeSprings(std::span<const int> springs) = 0;
    // Limits to be looked at (springs); of one of them, which had some before.
    virtual void watchLengths(std::span<const mechanics::LengthLimits> limits) = 0;
    virtual void watchLength(int spring, const mechanics::LengthLimits& limits) = 0;
    // Appends the springs that are beyond them.
    virtual void findBeyond(std::vector<int>& springs) const = 0;
    // Makes the generators of all forces anew.
    virtual void setForces(const ForceList& forces) = 0;
    // Whether any of them that acts here is a callback.
    virtual bool callsBack(const ForceList& forces) const = 0;
    // Where all of them go on from those before.
    virtual void steer(const ForceList& forces) = 0;
    // The path of a grip is another.
    virtual void leadGrip(std::size_t grip) = 0;

    // Whether the method splits the dashpots off, to be said before start().
    virtual void split(bool splits) = 0;
    // The method, from positions and velocities at t [s] on, in steps of h [s].
    virtual void start(double t, double h) = 0;
    virtual void step(double t) = 0;
    // Brings the points that collide out of the colliders; where they were before the step has been remembered. Returns
    // whether any was touched; contacts are appended where they are asked for.
    virtual void rememberPositions() = 0;
    virtual bool collide(const collision::Colliders& colliders, std::vector<collision::Contact>* contacts) = 0;
    // After that: points that began inside a collider go on their way out no faster than emergingSpeed; those that are
    // out leave the list.
    virtual void emerge(const collision::Colliders& colliders, std::vector<int>& inside) = 0;
    // After contact with other bodies, between two steps: points (ascending) go to x [m] with a velocity v [m/s] as the
    // method stores it, and out of the colliders where those stop them on their way. Both become what is kept.
    virtual void place(const collision::Colliders* colliders, std::span<const int> points, std::span<dvec3> x,
                       std::span<dvec3> v) = 0;
    // After contact of either sort, before anything else is asked: constraints share what it changed. Whether they did.
    virtual bool settle() = 0;
    // The largest |l - L|/L of what constraints tie, of points that count, at t [s].
    virtual double strain(double t, const std::vector<bool>& only) = 0;
    // [N s] by which ties of constraints have pulled since those were forgotten; and what that, in so many seconds up
    // to t [s], adds to ω² [1/s²].
    virtual void forgetImpulses() = 0;
    virtual dvec3 impulse(const JointTie::Part& part) const = 0;
    virtual double turning(double t, double seconds) = 0;
    // Whether collide() sums up what it does to the energy, and that sum since it was last taken.
    virtual void watchContacts(bool isOn) = 0;
    virtual ContactWork takeContactWork() = 0;
    // The acceleration of uniform fields [m/s²].
    virtual dvec3 gravity(double t) const = 0;
    // The speed [m/s] along an axis below which rounding leaves a point at such a place on it; 0 in double precision.
    virtual double freezingSpeed(double place) const = 0;
    // To be called after every tick of so many seconds where such a speed matters: the point whose velocity has led
    // furthest since it has been stuck along an axis, or -1 where none by more than `most` [m].
    struct Lost {
        int point = -1, plane = 0;
    };
    virtual Lost lost(double seconds, double most) = 0;
    // The state as it is, to come back to: at the start of a tick, or of a step.
    virtual void keep(Since moment) = 0;
    virtual void goBack(Since moment) = 0;
    // The length of the steps to come, of a state that was read.
    virtual void setStep(double h) = 0;
    // The bounds of springs and cells as they are now.
    virtual mechanics::FastestNow fastestNow() = 0;
    virtual ode::Work work() const = 0;  // since the island was made or read

    // Velocities as the method stores them, those at t [s], which may cost an evaluation, and the first made the
    // second. Contacts, those at t, point by point, bear what forces have added since the velocities that are stored.
    // What is pressed goes on being so.
    virtual std::vector<dvec3> velocities() const = 0;
    virtual void velocities(std::span<dvec3> v) const = 0;
    virtual std::vector<dvec3> velocitiesAt(double t, std::span<const collision::Contact> contacts,
                                            std::span<const ContactAcceleration> pressed) = 0;
    virtual void synchronise(double t, std::span<const collision::Contact> contacts,
                             std::span<const ContactAcceleration> pressed) = 0;
    virtual void setVelocity(int point, const dvec3& v) = 0;
    // Whether every velocity is a number below the limit, and those of points that the last collide() touched.
    virtual bool isBounded() const = 0;
    virtual bool isTouchedBounded() const = 0;
    virtual dvec3 position(int point) const = 0;
    virtual void positions(std::vector<dvec3>& x) const = 0;
    virtual void positions(std::span<dvec3> x) const = 0;

    // What the generators say, at t [s].
    virtual mechanics::StabilityShare stabilityShare(double t) const = 0;
    virtual void addEnergies(double t, const std::vector<bool>& only, double& uniform, double& other) const = 0;
    virtual void addStiffnessProduct(std::span<const dvec3> u, std::span<dvec3> out) const = 0;
    // Of the bodies that have cells.
    virtual std::vector<std::pair<const Body*, mechanics::VolumeReport>> volumes(double t, bool stretches) const = 0;

    // x and the stored v of points.
    virtual void addToHash(std::span<const int> points, core::Hash& hash) const = 0;
    virtual void visit(StateBytes& bytes) = 0;          // the state
    virtual void describe(IslandInfo& info) const = 0;  // its runs, single springs and bytes
};

// At rest at the plan's positions, with its velocities, in the precision of its solver. Expects that the plan stays.
std::unique_ptr<Dynamics> makeDynamics(const IslandPlan& plan, const ForceList& forces);

}  // namespace taut::world
