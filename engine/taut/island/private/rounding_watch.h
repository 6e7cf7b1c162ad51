// Finds points that single precision keeps in place: h v is below half a unit in the last place of x. It knows no
// island.
#pragma once

#include <cmath>
#include <limits>

#include "taut/island/private/dynamics.h"
#include "taut/ode/method.h"
#include "taut/plan/state_bytes.h"

namespace taut::world {

template <class Real>
class RoundingWatch {
  public:
    // See Dynamics::freezingSpeed(); steps of h [s].
    static double freezingSpeed(double place, double h) {
        if constexpr (sizeof(Real) == sizeof(double)) return 0.0;
        const Real x = static_cast<Real>(std::abs(place));
        const Real next = std::nextafter(x, std::numeric_limits<Real>::infinity());
        return 0.5 * static_cast<double>(next - x) / h;
    }
    Dynamics::Lost find(const ode::State<Real>& state, const Real* inverseMass, double h, double seconds, double most) {
        if (lost_.size() != state.x.size()) lost_ = core::AlignedArray<Real>(state.x.size());
        const Real step = static_cast<Real>(h), length = static_cast<Real>(seconds);
        Real worst = static_cast<Real>(most);
        Dynamics::Lost found;
        for (int p = 0; p < state.layout.planes; ++p)
            for (int i = 0; i < state.layout.count; ++i) {
                const auto k = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) * state.layout.stride + i);
                const Real x = state.x[k], v = state.v[k];
                const bool isStuck = x + step * v == x && inverseMass[i] != Real(0);
                lost_[k] = isStuck ? lost_[k] + length * v : Real(0);
                if (!(std::abs(lost_[k]) > worst)) continue;
                worst = std::abs(lost_[k]);
                found = {i, p};
            }
        return found;
    }
    // size: of the arrays of planes.
    void visit(StateBytes& bytes, std::size_t size) {
        bool has = lost_.size() > 0;
        bytes(has);
        if (has != (lost_.size() > 0)) lost_ = core::AlignedArray<Real>(has ? size : 0);
        if (has) bytes.planes(lost_);
    }

  private:
    core::AlignedArray<Real> lost_;  // [m] way by the velocities that stuck positions have not gone
};

}  // namespace taut::world
