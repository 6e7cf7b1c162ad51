// The interface of implicit methods to a second-order system besides accelerations: masses, and products with the
// derivatives of its forces.
#pragma once

namespace taut::ode {

// The derivatives of the forces F = m a_el: K = -∂F/∂x [N/m] and C = -∂F/∂v [kg/s], symmetric and positive
// semidefinite. Parts of the true ones that are not so are left out.
template <class Real>
class ImplicitSystem {
  public:
    virtual ~ImplicitSystem() = default;
    virtual const Real* masses() const = 0;         // (stride) m [kg] > 0
    virtual const Real* inverseMasses() const = 0;  // (stride) [1/kg], 0: the point is held, or moved by hand

    // Fixes W = stiffness K + damping C at (t, x, v) for the products that follow.
    virtual void linearise(double t, const Real* x, const Real* v, double stiffness, double damping) = 0;
    virtual void addProduct(const Real* u, Real* out) const = 0;  // out += W u, both (layout.size()) as positions
    virtual void addDiagonal(Real* out) const = 0;                // out += the diagonal of W
};

}  // namespace taut::ode
