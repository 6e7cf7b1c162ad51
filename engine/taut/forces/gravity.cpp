#include "taut/mechanics/gravity.h"

#include "taut/forces/anchor.h"
#include "taut/forces/private/scene_forces.h"
#include "taut/forces/wind.h"
#include "taut/spec/spec.h"

namespace taut::world {
namespace {

// Of all mass, the air's too, or of the air alone, from which it takes its weight back.
enum class Weighs { allMass, airBack };

class GravityForce final : public ForceOf<GravityForce> {
  public:
    GravityForce(const dvec3& acceleration, Weighs weighs)
        : ForceOf("world.gravity"), acceleration_{acceleration, acceleration}, weighs_(weighs) {}

    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan& plan) const {
        if (weighs_ == Weighs::allMass) return std::make_unique<mechanics::Gravity<Real>>(acceleration_);
        std::vector<Real> back;
        bool hasAir = false;
        for (const mechanics::PointMass& point : plan.points) {
            back.push_back(static_cast<Real>(-point.airMass));
            hasAir = hasAir || point.airMass > 0;
        }
        if (!hasAir) return nullptr;
        return std::make_unique<mechanics::Gravity<Real>>(acceleration_, std::move(back));
    }
    void changeEvenly(const GravityForce& from, const GravityForce& to, double t0, double t1) {
        acceleration_ = mechanics::LinearPath::between(from.acceleration_.to, to.acceleration_.to, t0, t1);
    }
    bool follows(const GravityForce& before) const { return before.acceleration_.to == acceleration_.from; }
    template <class Real>
    void guide(mechanics::ForceGenerator<Real>& generator) const {
        static_cast<mechanics::Gravity<Real>&>(generator).setAcceleration(acceleration_);
    }
    bool isSteady() const override { return true; }
    void visit(StateBytes& bytes) override { bytes(acceleration_); }

  private:
    mechanics::LinearPath acceleration_;  // [m/s²]
    Weighs weighs_;
};

}  // namespace

ForceList sceneForces(const SceneSpec& spec) {
    ForceList all{std::make_shared<GravityForce>(spec.world.gravity, Weighs::allMass)};
    const auto add = [&](const auto& forces) {
        for (const ForceSpec& force : forces)
            if (auto made = force.make(spec)) all.push_back(std::move(made));
    };
    add(spec.forces.of<WindSpec>());
    if (!spec.forces.of<WindSpec>().empty())
        all.push_back(std::make_shared<GravityForce>(spec.world.gravity, Weighs::airBack));
    add(spec.forces.of<AnchorSpec>());
    for (const ForceSpec& force : spec.forces)
        if (force.kind() != WindSpec::kindName && force.kind() != AnchorSpec::kindName)
            if (auto made = force.make(spec)) all.push_back(std::move(made));
    return all;
}

}  // namespace taut::world
