#include "taut/mechanics/gravity.h"

#include "taut/world/forces/scene_forces.h"

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

std::shared_ptr<const Force> gravityForce(const WorldSpec& world) {
    return std::make_shared<GravityForce>(world.gravity);
}

ForceList sceneForces(const SceneSpec& spec) {
    ForceList all{gravityForce(spec.world)};
    for (const WindSpec& wind : spec.winds)
        if (auto force = windForce(wind, spec.world.airDensity)) all.push_back(std::move(force));
    for (const AnchorSpec& anchor : spec.anchors) all.push_back(anchorForce(anchor));
    return all;
}

}  // namespace taut::world
