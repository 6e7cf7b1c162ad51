// A condition on points of an island that holds exactly, where springs would only pull: rods, limits, or one of the
// user's own. It knows no method and no tick. An island projects it after each step and again after contact
// (constraint_slot.h).
//
// To add one: derive from ConstraintOf, and let a kind of joint put it into IslandPlan::constraints;
// tests/unit/world_own_joint_test.cpp does.
#pragma once

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/body/spot.h"
#include "taut/core/rigid_motion.h"
#include "taut/plan/state_bytes.h"

namespace taut::world {

struct IslandPlan;
using glm::dvec3;

class Constraint {
  public:
    // A place on a collider; it moves with the collider.
    struct Place {
        std::string collider;  // "collider.pole"
        dvec3 offset;          // [m] from the collider, as it is unturned
    };
    // Points first, in the order of points(), then places. Points that are held or in a rigid grip, and places on
    // colliders, have an inverse mass of 0.
    struct Moment {
        std::span<const double> inverseMass;  // [1/kg]
        std::span<const dvec3> from;          // [m] when the step began: gradients there keep momentum
        std::span<dvec3> x;                   // [m]
        std::span<dvec3> v;                   // [m/s] at the time of x
        // (ties) Adds to this the pull of each tie on its first end: mass times change of x [kg m] or of v [kg m/s]. A
        // constraint of one tie may omit it; it follows from its points.
        std::span<dvec3> pull;
        double time = 0;       // [s] of x and v
        bool isOfStep = true;  // a change of x changes v; after contact it does not
    };

    virtual ~Constraint() = default;
    virtual std::span<const int> points() const = 0;  // of the plan, each once
    virtual std::span<const Place> places() const { return {}; }

    // Moves x to where the constraint holds, along gradients at `from`. Displacements go with the inverse masses
    // and add no momentum. Returns whether any x changed by more than rounding.
    virtual bool projectPositions(const Moment& moment) = 0;
    // The same for v. Afterwards v has no component along the gradients at x.
    virtual bool projectVelocities(const Moment& moment) = 0;

    // Torques between two bodies about an axis that both share, or forces along it, once a step. The axis goes through
    // the first two spots of a body, the third is beside it; at the start the spots of a and b are the same places.
    struct Drive {
        std::array<Spot, 3> a, b;    // numbers as in Moment
        double damping = 0;          // [N m s]; all numbers for an axis along which b slides: [N s/m], [N], [m/s], [N]
        double friction = 0;         // [N m] largest torque that slows the turn
        double speed = 0, most = 0;  // [rad/s] of b against a that a motor seeks, [N m] its largest torque; 0: none
        bool slides = false;
    };
    virtual std::vector<Drive> drives() const { return {}; }
    // A spring between two places, a force that holds nothing.
    struct Pull {
        Spot a, b;                                      // numbers as in Moment
        double stiffness = 0, damping = 0, length = 0;  // [N/m], [kg/s], [m]; no stiffness: it is broken
    };
    virtual std::vector<Pull> pulls() const { return {}; }  // (ties), or none
    // The motion of its points, if they are one body that moves. The arrays as in Moment.
    virtual std::optional<core::RigidMotion> bodyAt(std::span<const dvec3> /*x*/, std::span<const dvec3> /*v*/,
                                                    std::span<const double> /*inverseMass*/) const {
        return std::nullopt;
    }
    // Pairs that it holds at t [s], in one place or at a distance, with numbers as in Moment, and the tie that bears
    // them. None in one place follows from the others.
    struct Pair {
        Spot a, b;
        int tie;
        double length = 0;    // [m]
        bool isMost = false;  // of the length: they may be nearer
        // b is held on the line from a through this spot of the same body, and not along it.
        std::optional<Spot> line{};
    };
    virtual std::span<const Pair> pairs(double /*t*/) { return {}; }
    // Its pairs, if from t [s] on all that it does is to hold each a, a point, in the place of b: in such an order that
    // no b is the a of a later pair. None if it holds nothing.
    virtual std::optional<std::vector<Pair>> joinedFrom(double /*t*/) const { return std::nullopt; }

    // Number of its ties, with the released ones. They are numbered from 0.
    virtual int size() const { return 1; }
    // The largest |l - L|/L of ties whose ends all count. Both arrays as in Moment.
    virtual double strain(std::span<const dvec3> /*x*/, const std::vector<bool>& /*counts*/) const { return 0.0; }
    // The share of forces along ties in ω² of points that turn about them. forces: (ties) [N]; the other arrays as in
    // Moment.
    virtual double turning(std::span<const dvec3> /*x*/, std::span<const double> /*inverseMass*/,
                           std::span<const dvec3> /*forces*/) const {
        return 0.0;
    }
    // Whether it ties this point of the plan to a collider, so that other points do not matter.
    virtual bool carries(int /*point*/) const { return false; }
    // Whether a part of it waits for a time up to t [s]. begin() starts it between ticks, from x [m] of the plan.
    virtual bool isDue(double /*t*/) const { return false; }
    virtual void begin(double /*t*/, std::span<const dvec3> /*x*/) {}
    // Takes over lengths of springs of the plan, and which are broken.
    virtual void follow(const IslandPlan&) {}
    // Throws core::Error(badContent) if it can never hold.
    virtual void check() const {}

    // A released tie stays released.
    bool holds(int tie = 0) const { return gone_.empty() || !gone_[tie]; }
    void letGo(int tie);
    int count() const { return size() - static_cast<int>(std::count(gone_.begin(), gone_.end(), true)); }  // that hold

    // Writes or reads its state between ticks.
    void visit(StateBytes& bytes);
    virtual std::shared_ptr<Constraint> copy() const = 0;

  protected:
    virtual void visitOwn(StateBytes&) {}  // besides the released ties
    virtual void tiesChanged() {}          // some ties were released

  private:
    std::vector<bool> gone_;  // (ties) whether it was released; empty: none
};

inline void Constraint::letGo(int tie) {
    gone_.resize(size(), false);
    gone_[tie] = true;
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

// Implements the members that are the same for every constraint.
template <class Own>
class ConstraintOf : public Constraint {
  public:
    std::shared_ptr<Constraint> copy() const final { return std::make_shared<Own>(static_cast<const Own&>(*this)); }
};

}  // namespace taut::world
