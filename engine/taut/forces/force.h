// A force on points of bodies besides their springs: gravity, wind, an anchor, or one of the user's own. One force acts
// on the whole world; each island makes a generator for its part. It knows no method.
//
// To add one: derive from ForceOf, write make<Real>(), and pass it to World::addForce().
// tests/unit/world_forces_test.cpp does so.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/plan/island_plan.h"
#include "taut/plan/state_bytes.h"

namespace taut::world {

// A force during one tick. It never changes; a new one replaces it.
class Force {
  public:
    explicit Force(std::string name) : name_(std::move(name)) {}
    virtual ~Force() = default;

    // "wind.breeze": one force keeps its name at all times; different forces have different names.
    const std::string& name() const { return name_; }

    // Makes its generator for the points of an island, numbered as in its plan; null if it does nothing there. The
    // generator may rely on the plan's numbering, triangles and damage only. Masses and pinned points come with Motion.
    virtual std::unique_ptr<mechanics::ForceGenerator<float>> inSingle(const IslandPlan& plan) const = 0;
    virtual std::unique_ptr<mechanics::ForceGenerator<double>> inDouble(const IslandPlan& plan) const = 0;

    // The force during a tick from t0 to t1 [s]: `from` holds at its start, this one in its middle, `to` at its end.
    // Values that can change evenly do so. All others keep their value of the middle. Expects the same kind.
    virtual std::shared_ptr<const Force> during(const Force& from, const Force& to, double t0, double t1) const = 0;
    // Whether it continues the force of the previous tick without a jump. If so, no method has to start again.
    virtual bool goesOn(const Force& before) const = 0;
    // Expects that it continues: gives the changed values to the generator that the previous force made.
    virtual void steer(mechanics::ForceGenerator<float>& generator) const = 0;
    virtual void steer(mechanics::ForceGenerator<double>& generator) const = 0;

    // Whether it calls a function of the program that uses the engine. If so, its islands advance one after another, in
    // their order, and its bits may differ between machines.
    virtual bool isCallback() const { return false; }

    // Whether, as long as it is not replaced, it is a function of places and velocities alone. Where any other force
    // acts nothing sleeps.
    virtual bool isSteady() const { return false; }

    // visit() reads or writes all that may differ from the force at the start of the scene. copy() makes a force to
    // read into.
    virtual void visit(StateBytes& bytes) = 0;
    virtual std::shared_ptr<Force> copy() const = 0;

  private:
    std::string name_;
};

// Whether both save the same values.
bool hasSameBytes(const Force& a, const Force& b);

// The common part of all forces. `Own` must have
//   template <class Real> std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan&) const;
// Forces that change while they act override the rest: visit() for all values that a ramp or the force itself changes,
// the others for changes without a restart of the method.
template <class Own>
class ForceOf : public Force {
  public:
    using Force::Force;

    std::unique_ptr<mechanics::ForceGenerator<float>> inSingle(const IslandPlan& plan) const final {
        return own().template make<float>(plan);
    }
    std::unique_ptr<mechanics::ForceGenerator<double>> inDouble(const IslandPlan& plan) const final {
        return own().template make<double>(plan);
    }
    std::shared_ptr<const Force> during(const Force& from, const Force& to, double t0, double t1) const final {
        auto changing = std::make_shared<Own>(own());
        changing->changeEvenly(dynamic_cast<const Own&>(from), dynamic_cast<const Own&>(to), t0, t1);
        return changing;
    }
    bool goesOn(const Force& before) const final {
        const Own* same = dynamic_cast<const Own*>(&before);
        return same != nullptr && own().follows(*same);
    }
    void steer(mechanics::ForceGenerator<float>& generator) const final { own().template guide<float>(generator); }
    void steer(mechanics::ForceGenerator<double>& generator) const final { own().template guide<double>(generator); }
    void visit(StateBytes&) override {}
    std::shared_ptr<Force> copy() const final { return std::make_shared<Own>(own()); }

    // For forces that do not change.
    void changeEvenly(const Own&, const Own&, double, double) {}
    bool follows(const Own& before) const { return hasSameBytes(*this, before); }
    template <class Real>
    void guide(mechanics::ForceGenerator<Real>&) const {}

  private:
    const Own& own() const { return static_cast<const Own&>(*this); }
};

// The forces of a world during a tick, in the order in which an island adds them.
using ForceList = std::vector<std::shared_ptr<const Force>>;

// The forces of `middle`. Each changes evenly where all three lists have it.
ForceList during(const ForceList& from, const ForceList& middle, const ForceList& to, double t0, double t1);

// Whether these are the same forces as before, and each continues without a jump.
bool goesOn(const ForceList& before, const ForceList& now);

// Writes the forces, or reads them over those at the start of the scene: gravity, winds, anchors, then added forces,
// whose names the world has compared. Throws core::Error(badContent) if the bytes have other forces.
void visit(StateBytes& bytes, ForceList& forces);

}  // namespace taut::world
