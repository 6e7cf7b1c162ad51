// A condition on points of an island that holds exactly, where springs would only pull: rods, limits, one of the user's
// own. It knows no method and no tick; an island projects it after each step and again after contact
// (constraint_slot.h).
//
// To add one: derive from ConstraintOf, and let a kind of joint put it into IslandPlan::constraints;
// tests/unit/world_own_joint_test.cpp does.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "taut/bodies/state_bytes.h"

namespace taut::world {

using glm::dvec3;

class Constraint {
  public:
    // On a collider, and goes as that does.
    struct Place {
        std::string collider;  // "collider.pole"
        dvec3 offset;          // [m] from it, as it is unturned
    };
    // Points first, in the order of points(), then places. Points that are held or in a rigid grip, and places on
    // colliders, have an inverse mass of 0.
    struct Moment {
        std::span<const double> inverseMass;  // [1/kg]
        std::span<const dvec3> from;          // [m] when the step began: gradients there keep momentum
        std::span<dvec3> x;                   // [m]
        std::span<dvec3> v;                   // [m/s] at the time of x
    };

    virtual ~Constraint() = default;
    virtual std::span<const int> points() const = 0;  // of the plan, each once
    virtual std::span<const Place> places() const { return {}; }

    // Moves x to where the constraint holds, along gradients at `from`. Displacements go with the inverse masses
    // and add no momentum. Returns whether any x changed by more than rounding.
    virtual bool projectPositions(const Moment& moment) = 0;
    // The same for v: afterwards its component along the gradients at x is zero.
    virtual bool projectVelocities(const Moment& moment) = 0;

    // How many ties it has, and the largest |l - L|/L of those whose ends all count; both arrays as in Moment.
    virtual int count() const { return 1; }
    virtual double strain(std::span<const dvec3> /*x*/, const std::vector<bool>& /*counts*/) const { return 0.0; }
    // Throws core::Error(badContent) where it can never hold.
    virtual void check() const {}

    // Removes what a cut goes through (isCut is asked for pairs of points of the plan), or what is tied to a collider
    // that is gone. Both return whether anything changed.
    using IsCut = std::function<bool(int a, int b)>;
    virtual bool sever(const IsCut&) { return false; }
    virtual bool release(const std::string& /*collider*/) { return false; }
    // All that those two change, and the constraint itself between ticks, read or written.
    virtual void visit(StateBytes&) {}
    virtual std::shared_ptr<Constraint> copy() const = 0;
};

// Implements what is the same for every constraint.
template <class Own>
class ConstraintOf : public Constraint {
  public:
    std::shared_ptr<Constraint> copy() const final { return std::make_shared<Own>(static_cast<const Own&>(*this)); }
};

}  // namespace taut::world
