#include "taut/mechanics/gravity.h"

#include "taut/forces/anchor.h"
#include "taut/forces/private/scene_forces.h"
#include "taut/forces/wind.h"
#include "taut/spec/spec.h"

namespace taut::world {
namespace {

class GravityForce final : public ForceOf<GravityForce> {
  public:
    explicit GravityForce(const dvec3& acceleration)
        : ForceOf("world.gravity"), acceleration_{acceleration, acceleration} {}

    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan&) const {
        return std::make_unique<mechanics::Gravity<Real>>(acceleration_);
    }
    void changeEvenly(const GravityForce& from, const GravityForce& to, double t0, double t1) {
        acceleration_ = mechanics::LinearPath::between(from.acceleration_.to, to.acceleration_.to, t0, t1);
    }
    bool follows(const GravityForce& before) const { return before.acceleration_.to == acceleration_.from; }
    template <class Real>
    void guide(mechanics::ForceGenerator<Real>& generator) const {
        static_cast<mechanics::Gravity<Real>&>(generator).setAcceleration(acceleration_);
    }
    void visit(StateBytes& bytes) override { bytes(acceleration_); }

  private:
    mechanics::LinearPath acceleration_;  // [m/s²]
};

}  // namespace

ForceList sceneForces(const SceneSpec& spec) {
    ForceList all{std::make_shared<GravityForce>(spec.world.gravity)};
    const auto add = [&](const auto& forces) {
        for (const ForceSpec& force : forces)
            if (auto made = force.make(spec)) all.push_back(std::move(made));
    };
    add(spec.forces.of<WindSpec>());
    add(spec.forces.of<AnchorSpec>());
    for (const ForceSpec& force : spec.forces)
        if (force.kind() != WindSpec::kindName && force.kind() != AnchorSpec::kindName)
            if (auto made = force.make(spec)) all.push_back(std::move(made));
    return all;
}

}  // namespace taut::world
