// A condition on points of an island that holds exactly, where springs would only pull: rods, limits, one of the user's
// own. It knows no method and no tick; an island projects it after each step and again after contact
// (constraint_slot.h).
//
// To add one: derive from ConstraintOf, and let a kind of joint put it into IslandPlan::constraints;
// tests/unit/world_own_joint_test.cpp does.
#pragma once

#include <algorithm>
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
        // (ties) What each pulls its first end with is to be added: mass times change of x [kg m] or of v [kg m/s]. Of
        // one tie alone that is seen from its points.
        std::span<dvec3> pull;
    };

    virtual ~Constraint() = default;
    virtual std::span<const int> points() const = 0;  // of the plan, each once
    virtual std::span<const Place> places() const { return {}; }

    // Moves x to where the constraint holds, along gradients at `from`. Displacements go with the inverse masses
    // and add no momentum. Returns whether any x changed by more than rounding.
    virtual bool projectPositions(const Moment& moment) = 0;
    // The same for v: afterwards its component along the gradients at x is zero.
    virtual bool projectVelocities(const Moment& moment) = 0;

    // Ties that were put into it, those that have let go among them: they are numbered from 0.
    virtual int size() const { return 1; }
    // The largest |l - L|/L of ties whose ends all count; both arrays as in Moment.
    virtual double strain(std::span<const dvec3> /*x*/, const std::vector<bool>& /*counts*/) const { return 0.0; }
    // What forces along ties add to ω² of points that they turn about: (ties) [N] and both arrays as in Moment.
    virtual double turning(std::span<const dvec3> /*x*/, std::span<const double> /*inverseMass*/,
                           std::span<const dvec3> /*forces*/) const {
        return 0.0;
    }
    // Whether a collider carries this point of the plan by it, wherever others are.
    virtual bool carries(int /*point*/) const { return false; }
    // Throws core::Error(badContent) where it can never hold.
    virtual void check() const {}

    // Ties that let go do so for good.
    bool holds(int tie = 0) const { return gone_.empty() || !gone_[static_cast<std::size_t>(tie)]; }
    void letGo(int tie);
    int count() const { return size() - static_cast<int>(std::count(gone_.begin(), gone_.end(), true)); }  // that hold

    // The constraint between ticks, read or written.
    void visit(StateBytes& bytes);
    virtual std::shared_ptr<Constraint> copy() const = 0;

  protected:
    virtual void visitOwn(StateBytes&) {}  // besides what has let go
    virtual void tiesChanged() {}          // some have let go

  private:
    std::vector<bool> gone_;  // (ties) empty: none has
};

inline void Constraint::letGo(int tie) {
    gone_.resize(static_cast<std::size_t>(size()), false);
    gone_[static_cast<std::size_t>(tie)] = true;
    tiesChanged();
}

inline void Constraint::visit(StateBytes& bytes) {
    for (int tie = 0; tie < size(); ++tie) {
        bool isGone = !holds(tie);
        bytes(isGone);
        if (isGone) letGo(tie);
    }
    visitOwn(bytes);
}

// Implements what is the same for every constraint.
template <class Own>
class ConstraintOf : public Constraint {
  public:
    std::shared_ptr<Constraint> copy() const final { return std::make_shared<Own>(static_cast<const Own&>(*this)); }
};

}  // namespace taut::world
