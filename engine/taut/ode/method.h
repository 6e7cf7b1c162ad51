// A method that takes a second-order system from t to t + h. It knows no physics: only flat arrays.
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

// All that a run carries from step to step: a copy of it is a checkpoint.
template <class Real>
struct State {
    State() = default;
    explicit State(Layout shape) : layout(shape), x(shape.size()), v(shape.size()) {}
    Layout layout;
    core::AlignedArray<Real> x;                    // positions at t
    core::AlignedArray<Real> v;                    // velocities as the method stores them (leap-frog: at t - h/2)
    std::vector<core::AlignedArray<Real>> memory;  // what else the method keeps, sized by start()
};

// How methods that solve equations, or split them, go about it; the others have no use for it.
struct MethodOptions {
    int newtonSteps = 1;       // >= 1 linear solves a step; the first alone is Baraff and Witkin's method
    double tolerance = 1e-5;   // of a solve, residual over right-hand side; single precision stops at 1e-6
    int maxIterations = 1000;  // of a solve
    bool splits = false;       // leap-frog: the system's split part
};

// What a method found among the velocities that a step wrote; unknown when it did not look.
enum class Speeds { unknown, within, beyond };

// A point that a contact holds up: along a unit normal, or where that is zero in all directions.
struct Support {
    int point = 0;
    std::array<double, 3> normal{};  // (planes)
    std::array<double, 3> rub{};     // (planes) [m/s] what friction changes of its velocity, across the normal
    double impulse = 0;              // [m/s] per mass, along it: found by the method
};

template <class Real>
class Method {
  public:
    virtual ~Method() = default;

    // Takes state.x and state.v, both at time t, and prepares the first step: at the start and after every event.
    virtual void start(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) = 0;

    // From t to t + h [s], h that of start(). Reports nothing: a state that diverges is for the caller to find.
    virtual void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) = 0;

    // The velocities at time t into v (layout.size()); may cost an evaluation. The state stays as it is.
    virtual void synchronise(SecondOrderSystem<Real>& system, double t, double h, const State<Real>& state,
                             Real* v) = 0;

    // Tells that the x and v of these points were changed after the step, by a contact.
    virtual void touch(State<Real>& state, std::span<const int> points) = 0;

    // The best known velocities at the time of the positions without another evaluation; they belong to the state.
    virtual const Real* predicted(const State<Real>& state) const { return state.v.data(); }
    // The same, to be changed. It is not state.v where a method stores v at another time.
    Real* predicted(State<Real>& state) const { return const_cast<Real*>(predicted(std::as_const(state))); }

    // Whether contacts affect other points than those that touch, as in methods that solve for all points at once.
    virtual bool yields() const { return false; }
    // After a step from t to t + h and touch(): solves for the step once more. Points with a normal end as far along it
    // as they are now, and keep their v along it; those without stay where they are, as they are. May be called again
    // with others.
    virtual void yield(SecondOrderSystem<Real>& /*system*/, double /*t*/, double /*h*/, State<Real>& /*state*/,
                       std::span<Support> /*supports*/) {}

    virtual Work work() const { return work_; }  // since it was made

    // Asks step() to look for velocities that are not below the limit [m/s] in a plane, or are no numbers, and what it
    // found in the last step. Points that are moved by hand are not looked at.
    void watch(Real speedLimit) { speedLimit_ = speedLimit; }
    Speeds speeds() const { return speeds_; }

  protected:
    Work work_;
    Real speedLimit_ = std::numeric_limits<Real>::infinity();
    Speeds speeds_ = Speeds::unknown;
};

// The functions that make a method, one for each precision: of a method for any y' = f(t, y), or of one that needs
// x'' = a.
class MethodMakers {
  public:
    template <class Real>
    using FirstOrder = std::unique_ptr<FirstOrderMethod<Real>> (*)();
    template <class Real>
    using SecondOrder = std::unique_ptr<Method<Real>> (*)(const MethodOptions& options);

    constexpr MethodMakers(FirstOrder<float> single, FirstOrder<double> twice) : first_{single, twice} {}
    constexpr MethodMakers(SecondOrder<float> single, SecondOrder<double> twice) : second_{single, twice} {}

    constexpr bool isFirstOrder() const { return std::get<0>(first_) != nullptr; }
    // nullptr when it is of the other kind.
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

// A row of the table of methods: what a person should know of it before choosing it, its limits, and how it is made.
// The texts are not copied.
struct MethodInfo {
    std::string_view name;   // as scenes write it
    std::string_view title;  // as texts write it
    int order;               // of convergence
    int evaluations;         // of the acceleration, a step
    int storedArrays;        // of the size of x, besides x and v
    bool symplectic;
    bool reversible;
    std::string_view limit;    // largest stable z = ω h in words, for a damping ratio ζ
    std::string_view caution;  // what its limit does not promise; empty when it does
    // Largest stable h [s]; 0 when every h is unstable, infinite when none is.
    double (*largestStep)(const FastestMode& mode);
    // h [s] that may be taken without asking: the largest stable one or, of methods that let undamped motion grow at
    // every step, one at which it grows slowly.
    double (*automaticStep)(const FastestMode& mode);
    MethodMakers make;

    bool isFirstOrder() const { return make.isFirstOrder(); }  // integrates any y' = f(t, y); else it needs x'' = a
};

}  // namespace taut::ode
