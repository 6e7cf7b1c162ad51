// What keeps points of an island where springs would only draw them: rods, limits, one of the user's own. It knows no
// method and no tick; an island projects it after each step, and once more after contact (constraint_slot.h).
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
    // Points first, in the order of points(), then places. What is held, led or on a collider has an inverse mass of 0.
    struct Moment {
        std::span<const double> inverseMass;  // [1/kg]
        std::span<const dvec3> from;          // [m] when the step began: gradients there keep momentum
        std::span<dvec3> x;                   // [m]
        std::span<dvec3> v;                   // [m/s] at the time of x
    };

    virtual ~Constraint() = default;
    virtual std::span<const int> points() const = 0;  // of the plan, each once
    virtual std::span<const Place> places() const { return {}; }

    // Brings x to where it holds, along gradients at `from`, by displacements that are inverse to the masses and add up
    // to no momentum. What has no inverse mass stays. Whether any x changed by more than rounding.
    virtual bool projectPositions(const Moment& moment) = 0;
    // The same of v, so that it goes on holding at x.
    virtual bool projectVelocities(const Moment& moment) = 0;

    // How many ties it has, and the largest |l - L|/L of those whose ends all count; both arrays as in Moment.
    virtual int count() const { return 1; }
    virtual double strain(std::span<const dvec3> /*x*/, const std::vector<bool>& /*counts*/) const { return 0.0; }
    // Throws core::Error(badContent) where it can never hold.
    virtual void check() const {}

    // What a cut does to it, `isCut` being of two points of the plan; and a collider that is gone. Whether anything.
    using IsCut = std::function<bool(int a, int b)>;
    virtual bool sever(const IsCut&) { return false; }
    virtual bool release(const std::string& /*collider*/) { return false; }
    // All that those two change, and the constraint itself between ticks, read or written.
    virtual void visit(StateBytes&) {}
    virtual std::shared_ptr<Constraint> copy() const = 0;
};

// Writes what every constraint does alike.
template <class Own>
class ConstraintOf : public Constraint {
  public:
    std::shared_ptr<Constraint> copy() const final { return std::make_shared<Own>(static_cast<const Own&>(*this)); }
};

}  // namespace taut::world
