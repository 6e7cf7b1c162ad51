// The interface of methods to a system of ordinary differential equations over flat arrays, independent of physics.
#pragma once

#include <cstddef>

#include "taut/ode/implicit_system.h"
#include "taut/ode/split_system.h"

namespace taut::ode {

// y' = f(t, y).
template <class Real>
class System {
  public:
    virtual ~System() = default;
    virtual std::size_t size() const = 0;
    // dydt (size) from t and y (size).
    virtual void derivative(double t, const Real* y, Real* dydt) = 0;
    // Overwrites the unknowns that are prescribed at t instead of integrated.
    virtual void prescribe(double, Real*) {}
};

// The layout of second-order unknowns: `planes` coordinates, each an array of `stride` numbers of which the first
// `count` are in use. A mass-spring island has three planes, an oscillator one.
struct Layout {
    int count = 0;
    int stride = 0;  // >= count
    int planes = 1;
    std::size_t size() const { return static_cast<std::size_t>(stride) * static_cast<std::size_t>(planes); }
};

// Takes accelerations as they become final. a points at the planes of the range: a[p] holds last - first numbers.
template <class Real>
class AccelerationSink {
  public:
    virtual ~AccelerationSink() = default;
    virtual void take(int first, int last, const Real* const* a) = 0;
};

// x'' = a_el(t, x, v) - γ v, γ a rate a point [1/s]. a_el may depend on v (dashpots, wind). The part that is
// proportional to each point's own v is kept apart, so that methods can treat it implicitly.
template <class Real>
class SecondOrderSystem {
  public:
    virtual ~SecondOrderSystem() = default;
    virtual Layout layout() const = 0;
    virtual const Real* dragRates() const = 0;  // (stride) γ [1/s]
    // Evaluates a_el at (t, x, v) and hands it to the sink range by range, each point once, perhaps from several
    // threads. After a range is handed over, its x and v are not read any more: the sink may overwrite them.
    virtual void accelerate(double t, const Real* x, const Real* v, AccelerationSink<Real>& sink) = 0;
    // Overwrites positions and velocities of kinematic points with those at t; either may be null. Such
    // points have no acceleration. Methods call it for every time at which they ask for accelerations.
    virtual void prescribe(double, Real*, Real*) {}
    // The interface for implicit methods to the same system; nullptr if it is not offered.
    virtual ImplicitSystem<Real>* implicitPart() { return nullptr; }
    // The interface for methods that split off the stiff part; nullptr if it is not offered.
    virtual SplitSystem<Real>* splitPart() { return nullptr; }
};

// Presents a second-order system as a first-order one: y = (x planes, v planes), y' = (v, a_el - γ v).
template <class Real>
class FirstOrderView final : public System<Real> {
  public:
    explicit FirstOrderView(SecondOrderSystem<Real>& system) : system_(system) {}
    std::size_t size() const override { return 2 * system_.layout().size(); }
    void derivative(double t, const Real* y, Real* dydt) override {
        const Layout layout = system_.layout();
        const std::size_t half = layout.size();
        for (std::size_t i = 0; i < half; ++i) dydt[i] = y[half + i];
        Store store(layout, system_.dragRates(), y + half, dydt + half);
        system_.accelerate(t, y, y + half, store);
    }
    void prescribe(double t, Real* y) override { system_.prescribe(t, y, y + system_.layout().size()); }

  private:
    class Store final : public AccelerationSink<Real> {
      public:
        Store(Layout layout, const Real* drag, const Real* v, Real* out)
            : layout_(layout), drag_(drag), v_(v), out_(out) {}
        void take(int first, int last, const Real* const* a) override {
            for (int p = 0; p < layout_.planes; ++p) {
                const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(p) * layout_.stride;
                for (int i = first; i < last; ++i) out_[plane + i] = a[p][i - first] - drag_[i] * v_[plane + i];
            }
        }

      private:
        Layout layout_;
        const Real* drag_;
        const Real* v_;
        Real* out_;
    };
    SecondOrderSystem<Real>& system_;
};

}  // namespace taut::ode
