#include "taut/mechanics/gravity.h"

#include "taut/core/private/vectorise.h"

namespace taut::mechanics {

template <class Real>
void Gravity<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    const Real* mass = masses(motion);
    const glm::dvec3 acceleration = acceleration_.at(motion.t);
    for (int axis = 0; axis < 3; ++axis) {
        const Real g = static_cast<Real>(acceleration[axis]);
        if (g == Real(0)) continue;
        Real* plane = f + static_cast<std::ptrdiff_t>(axis) * motion.stride;
        TAUT_INDEPENDENT
        for (int i = first; i < last; ++i) plane[i] += mass[i] * g;
    }
}

template <class Real>
double Gravity<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    const glm::dvec3 acceleration = acceleration_.at(motion.t);
    const Real* mass = masses(motion);
    double energy = 0.0;
    for (int i = 0; i < motion.count; ++i) {
        if (!only.empty() && !only[i]) continue;
        const Real* x = motion.x + i;
        const std::ptrdiff_t stride = motion.stride;
        const glm::dvec3 position(x[0], x[stride], x[2 * stride]);
        energy -= static_cast<double>(mass[i]) * glm::dot(acceleration, position);
    }
    return energy;
}

template class Gravity<float>;
template class Gravity<double>;

}  // namespace taut::mechanics
