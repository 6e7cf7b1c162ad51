// An island in one precision; shared by the sources that make up its parts, and known to nobody else.
//
//   island.cpp          the tick
//   island_change.cpp   what is changed between two ticks, and the system made anew from it
//   island_report.cpp   energies, frequencies, warnings, why it stopped
//   island_saving.cpp   its bytes
//   plasticity.cpp      springs that give way and break
#pragma once

#include "taut/mechanics/anchor.h"
#include "taut/mechanics/volume.h"
#include "taut/world/island.h"
#include "taut/world/step_choice.h"

namespace taut::world {

template <class Real>
class IslandOf final : public Island {
  public:
    IslandOf(IslandPlan plan, const ForceList& forces, Envelope envelope, double ticksPerSecond, double t);

    void setColliders(collision::Colliders colliders) override { colliders_ = std::move(colliders); }
    std::optional<Fault> tick(const TickTime& time, std::span<const ColliderMotion> moving) override;
    bool settle(const TickTime& time) override;
    void undoTick() override { copyState(good_, state_); }
    void freeze(const Fault& fault, const TickTime& time) override;
    const FrozenIsland* frozen() const override { return frozen_ ? &*frozen_ : nullptr; }

    void open(const TickTime& time) override;
    void close(const TickTime& time) override;
    bool isOpen() const override { return isOpen_; }
    IslandPlan& change(const TickTime& time) override;
    void push(const TickTime& time, std::span<const int> points, const dvec3& velocity) override;
    void stop(const TickTime& time, std::span<const int> points) override;
    void lead(const TickTime& time, const std::string& hand, const mechanics::LinearPath& path, bool bends) override;
    void setForces(const TickTime& time, const ForceList& forces) override;

    const IslandPlan& plan() const override { return plan_; }
    double step() const override { return choice_.step; }
    dvec3 position(int point) const override { return at(state_.x, point); }
    std::span<const collision::Contact> contacts() const override { return contacts_; }
    std::vector<dvec3> velocities(const TickTime& time) override;

    void addToHash(const Body& body, core::Hash& hash) const override;
    void addPointToHash(int point, core::Hash& hash) const override;
    void addMetrics(const TickTime& time, const std::function<bool(const Body&)>& wanted, Metrics& metrics) override;
    ode::Work work() const override;
    IslandInfo info() const override;
    std::vector<std::string> warnings() const override;
    Divergence diagnose(const Fault& fault, const TickTime& time) const override;

    void visit(StateBytes& bytes) override;

  private:
    using System = mechanics::MassSpringSystem<Real>;

    static System systemOf(const IslandPlan& plan);
    void rebuild();
    void addGenerators();
    void addVolumes();
    void leadGrips();
    void makeMethod();
    mechanics::StabilityShare stabilityShare(double t) const;
    void chooseStepFor(Envelope& envelope, double tickSeconds, double t);
    void watchLimit(double t);

    std::size_t index(int point, int plane) const {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(plane) * state_.layout.stride + point);
    }
    dvec3 at(const core::AlignedArray<Real>& planes, int point) const {
        return {static_cast<double>(planes[index(point, 0)]), static_cast<double>(planes[index(point, 1)]),
                static_cast<double>(planes[index(point, 2)])};
    }
    mechanics::Motion<Real> motion(double t) const { return system_.motion(t, state_.x.data(), state_.v.data()); }
    double lengthOf(const mechanics::Spring& spring) const;
    // Velocities at the time of the tick, in velocity_.
    void synchronise(const TickTime& time);
    void ask(const TickTime& time);
    static void copyState(const ode::State<Real>& from, ode::State<Real>& to);

    bool isBounded() const;
    Fault giveUp(double t) const;
    std::optional<Fault> overstrained(double t) const;
    void collide(std::span<const ColliderMotion> moving, int substep);
    void watchVolumes(double t);
    double penetration(const std::vector<bool>& wanted) const;
    std::string_view methodTitle() const {
        return methodsOf(plan_.solver).find(plan_.solver.integrator)->title;
    }

    void visitPlan(StateBytes& bytes);

    IslandPlan plan_;
    ForceList forces_;
    System system_;
    // Among the system's generators:
    struct VolumeOf {
        const Body* body;
        const mechanics::VolumePreservation<Real>* volume;
    };
    std::vector<VolumeOf> volumes_;
    // Those of forces_ that act here, by their number.
    std::vector<std::pair<std::size_t, mechanics::ForceGenerator<Real>*>> acting_;
    std::vector<mechanics::Anchor<Real>*> gripAnchors_;                      // (grips) null for rigid ones

    StepChoice choice_;
    std::unique_ptr<ode::Method<Real>> method_;
    ode::Work workBefore_;                        // of what ran before this method was made
    ode::Work workOfQueries_;                     // of what was only asked, which the run does not need
    ode::State<Real> state_, good_;               // good: as the tick began, or the step where it may freeze
    core::AlignedArray<Real> before_, velocity_;  // (3 · stride) scratch
    bool isOpen_ = false;                         // v is at the time of x, and the method not started from there
    bool isReshaped_ = false;                     // the system is older than the plan
    bool isChanged_ = false;                      // the plan is not as it was built
    collision::Colliders colliders_;
    std::vector<collision::Contact> contacts_;  // of the last step
    std::vector<int> touched_;
    bool hasMoved_ = false;  // any tick yet
    std::string stretchWarning_, collapseWarning_, limitWarning_;
    std::optional<FrozenIsland> frozen_;
};

}  // namespace taut::world
