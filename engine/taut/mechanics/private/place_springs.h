// Springs, each with a dashpot, whose ends are weighted sums of points, such as places on a rigid body. Of some the
// second end is a place that moves by itself.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "taut/mechanics/force_generator.h"

namespace taut::mechanics {

// d = Σ w x - p is the way from the second end to the first, n = d/|d|. The force F = -(k (|d| - L) + c ḋ·n) n, or
// -(k d + c ḋ) if L = 0, acts with w F on each point: the ends get it with opposite signs, so momentum and angular
// momentum stay. Slopes leave out k (1 - L/|d|) (1 - n nᵀ) if it is negative.
struct PlaceSpring {
    struct Share {
        int point;
        double weight;
    };
    struct Place {
        glm::dvec3 x{0.0}, v{0.0};  // [m], [m/s]
    };
    std::vector<Share> shares;              // each point once
    std::function<Place(double t)> second;  // p; none: it is among the shares
    double stiffness = 0, damping = 0;      // k [N/m], c [kg/s] >= 0
    double length = 0;                      // L [m] >= 0
};

template <class Real>
class PlaceSprings final : public ForceGenerator<Real> {
  public:
    explicit PlaceSprings(std::vector<PlaceSpring> springs) : springs_(std::move(springs)) {}

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;
    // Bounds rows of the stiffness matrix at any places.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    std::vector<PlaceSpring> springs_;
    std::vector<glm::dmat3> slopes_;  // (springs) as linearise() found them
};

extern template class PlaceSprings<float>;
extern template class PlaceSprings<double>;

}  // namespace taut::mechanics
