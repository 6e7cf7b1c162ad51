// Force generators as in Millington's book, but for batches: one virtual call adds a force to all its points.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "taut/core/aligned_array.h"

namespace taut::mechanics {

// The points of one island, as a generator reads them. Planes x…x y…y z…z, each `stride` long.
template <class Real>
struct Motion {
    int count = 0;
    int stride = 0;
    double t = 0;                       // [s]
    const Real* x = nullptr;            // (3 · stride) [m]
    const Real* v = nullptr;            // (3 · stride) [m/s]
    const Real* mass = nullptr;         // (stride) [kg], also of held points
    const Real* inverseMass = nullptr;  // (stride) [1/kg], 0 if held
};

// A generator's share of the stability bound, per point where it acts.
struct StabilityShare {
    // (points) summed stiffness: an upper bound of the point's row of the stiffness matrix, without springs [N/m].
    std::vector<double> stiffness;
    // (points) rate at which it damps a point [1/s].
    std::vector<double> dampingRate;
};

template <class Real>
class ForceGenerator {
  public:
    virtual ~ForceGenerator() = default;

    // Whether the force on a point depends on that point alone. Then addForces() may be called for a part of the
    // points.
    virtual bool isLocal() const { return false; }

    // Adds the force on points first … last - 1 to f (3 · stride) [N]. Not local: first = 0, last = count.
    virtual void addForces(const Motion<Real>& motion, int first, int last, Real* f) const = 0;

    // Whether it only gives every point the same acceleration. The system then adds this to the free points itself, and
    // does not call addForces().
    virtual bool isUniform() const { return false; }
    virtual glm::dvec3 uniformAcceleration(double /*t*/) const { return glm::dvec3(0.0); }  // [m/s²]

    // Whether its potential energy is that of weight.
    virtual bool isWeight() const { return isUniform(); }

    // Potential energy [J] at the motion's positions; 0 for a force that has none. `only` (points) restricts it to the
    // energy between the marked points; empty: all points.
    virtual double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const = 0;

    // Adds K u to out (3 · stride), K = -∂f/∂x [N/m], u a displacement (3 · stride) [m]. Nothing when K = 0.
    virtual void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const = 0;

    // For implicit methods. The first call fixes W = stiffness K + damping C at the motion, C = -∂f/∂v [kg/s]; parts of
    // K and C that are not positive or not symmetric are left out. The others add products W u, and the diagonal of W,
    // to out. A force that depends on neither position nor velocity does nothing.
    virtual void linearise(const Motion<Real>&, double /*stiffness*/, double /*damping*/) {}
    virtual void addProduct(int /*stride*/, const Real* /*u*/, Real* /*out*/) const {}
    virtual void addDiagonal(int /*stride*/, Real* /*out*/) const {}

    // Adds its share of the bound at the given motion, if it has one.
    virtual void addStability(const Motion<Real>& motion, StabilityShare& share) const = 0;
};

}  // namespace taut::mechanics
