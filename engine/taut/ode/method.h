// A method that integrates a second-order system from t to t + h. It knows flat arrays and no physics.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/ode/fastest_mode.h"
#include "taut/ode/first_order_method.h"
#include "taut/ode/system.h"
#include "taut/ode/work.h"

namespace taut::ode {

// Everything that a run carries from step to step: a copy of it is a checkpoint.
template <class Real>
struct State {
    State() = default;
    explicit State(Layout shape) : layout(shape), x(shape.size()), v(shape.size()) {}
    Layout layout;
    core::AlignedArray<Real> x;                    // positions at t
    core::AlignedArray<Real> v;                    // velocities as the method stores them (leap-frog: at t - h/2)
    std::vector<core::AlignedArray<Real>> memory;  // further arrays of the method, sized by start()
};

// Settings of methods that solve equations, or split them; other methods do not use them.
struct MethodOptions {
    int newtonSteps = 1;       // >= 1 linear solves a step; the first alone is Baraff and Witkin's method
    double tolerance = 1e-5;   // of a solve, residual over right-hand side; single precision stops at 1e-6
    int maxIterations = 1000;  // of a solve
    bool splits = false;       // leap-frog: the system's split part
};

// The check of the velocities that a step wrote; unknown without a check.
enum class Speeds { unknown, within, beyond };

// A point that a contact holds: along a unit normal or, if `normal` is zero, in all directions.
struct Support {
    int point = 0;
    std::array<double, 3> normal{};  // (planes)
    std::array<double, 3> rub{};     // (planes) [m/s] change of its velocity by friction, across the normal
    double impulse = 0;              // [m/s] per mass, along it: found by the method
};

template <class Real>
class Method {
  public:
    virtual ~Method() = default;

    // Prepares the first step from state.x and state.v, both at time t. Call it at the start and after every event.
    virtual void start(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) = 0;

    // Integrates from t to t + h [s] with the h of start(). It reports nothing: the caller has to find a state that
    // diverges.
    virtual void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) = 0;

    // Writes the velocities at time t into v (layout.size()). This may cost an evaluation; the state does not change.
    virtual void synchronise(SecondOrderSystem<Real>& system, double t, double h, const State<Real>& state,
                             Real* v) = 0;

    // Tells the method that a contact changed x and v of these points after the step.
    virtual void touch(State<Real>& state, std::span<const int> points) = 0;

    // The best known velocities at the time of the positions, without another evaluation. They belong to the state.
    virtual const Real* predicted(const State<Real>& state) const { return state.v.data(); }
    // The same, for changes. It is not state.v if the method stores v at another time.
    Real* predicted(State<Real>& state) const { return const_cast<Real*>(predicted(std::as_const(state))); }

    // Whether contacts also affect points that do not touch, as in methods that solve for all points at once.
    virtual bool yields() const { return false; }
    // Call it after a step from t to t + h and touch(): it solves for the step once more. Points with a normal keep
    // their present position and v along it; points without one keep position and v. May be called again with other
    // points.
    virtual void yield(SecondOrderSystem<Real>& /*system*/, double /*t*/, double /*h*/, State<Real>& /*state*/,
                       std::span<Support> /*supports*/) {}

    virtual Work work() const { return work_; }  // since it was made

    // Makes step() look for velocities that are not below the limit [m/s] in a plane, or are NaN; returns the result of
    // the last step. Kinematic points are skipped.
    void watch(Real speedLimit) { speedLimit_ = speedLimit; }
    Speeds speeds() const { return speeds_; }

  protected:
    Work work_;
    Real speedLimit_ = std::numeric_limits<Real>::infinity();
    Speeds speeds_ = Speeds::unknown;
};

// The functions that make a method, one for each precision. Either the method takes any y' = f(t, y), or it needs x'' =
// a.
class MethodMakers {
  public:
    template <class Real>
    using FirstOrder = std::unique_ptr<FirstOrderMethod<Real>> (*)();
    template <class Real>
    using SecondOrder = std::unique_ptr<Method<Real>> (*)(const MethodOptions& options);

    constexpr MethodMakers(FirstOrder<float> single, FirstOrder<double> twice) : first_{single, twice} {}
    constexpr MethodMakers(SecondOrder<float> single, SecondOrder<double> twice) : second_{single, twice} {}

    constexpr bool isFirstOrder() const { return std::get<0>(first_) != nullptr; }
    // nullptr if the method is of the other kind.
    template <class Real>
    constexpr FirstOrder<Real> firstOrder() const {
        return std::get<FirstOrder<Real>>(first_);
    }
    template <class Real>
    constexpr SecondOrder<Real> secondOrder() const {
        return std::get<SecondOrder<Real>>(second_);
    }

  private:
    std::tuple<FirstOrder<float>, FirstOrder<double>> first_;
    std::tuple<SecondOrder<float>, SecondOrder<double>> second_;
};

// A row of the table of methods: its description for users, its limits, and its factory. The texts are not copied.
struct MethodInfo {
    std::string_view name;   // as scenes write it
    std::string_view title;  // as texts write it
    int order;               // of convergence
    int evaluations;         // of the acceleration, a step
    int storedArrays;        // of the size of x, besides x and v
    bool symplectic;
    bool reversible;
    std::string_view limit;    // largest stable z = ω h in words, for a damping ratio ζ
    std::string_view caution;  // exceptions of its limit; empty: none
    // Largest stable h [s]; 0 if every h is unstable, infinite if every h is stable.
    double (*largestStep)(const FastestMode& mode);
    // The h [s] that "auto" may choose: the largest stable one. Methods that let undamped motion grow at every step
    // return an h at which it grows slowly.
    double (*automaticStep)(const FastestMode& mode);
    MethodMakers make;

    bool isFirstOrder() const { return make.isFirstOrder(); }  // integrates any y' = f(t, y); else it needs x'' = a
};

}  // namespace taut::ode
