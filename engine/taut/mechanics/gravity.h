// A uniform gravitational field: m g on every point; g may change with time. With masses of its own it acts on those
// instead: minus the mass of the air that goes along with a cloth, which has inertia and no weight.
#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/linear_path.h"

namespace taut::mechanics {

template <class Real>
class Gravity final : public ForceGenerator<Real> {
  public:
    explicit Gravity(const glm::dvec3& acceleration) : acceleration_{acceleration, acceleration} {}  // [m/s²]
    explicit Gravity(const LinearPath& acceleration) : acceleration_(acceleration) {}                // [m/s²]
    // masses (points) [kg], may be negative.
    Gravity(const LinearPath& acceleration, std::vector<Real> masses)
        : acceleration_(acceleration), masses_(std::move(masses)) {}

    void setAcceleration(const glm::dvec3& acceleration) { acceleration_ = {acceleration, acceleration}; }
    void setAcceleration(const LinearPath& acceleration) { acceleration_ = acceleration; }

    bool isLocal() const override { return true; }
    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    bool isUniform() const override { return masses_.empty(); }
    bool isWeight() const override { return true; }
    glm::dvec3 uniformAcceleration(double t) const override { return acceleration_.at(t); }                 // if it is
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;  // -Σ m g·x
    void addStiffnessProduct(const Motion<Real>&, const Real*, Real*) const override {}
    void addStability(const Motion<Real>&, StabilityShare&) const override {}

  private:
    const Real* masses(const Motion<Real>& motion) const { return masses_.empty() ? motion.mass : masses_.data(); }

    LinearPath acceleration_;
    std::vector<Real> masses_;  // (points) [kg]; empty: those of the motion
};

extern template class Gravity<float>;
extern template class Gravity<double>;

}  // namespace taut::mechanics
