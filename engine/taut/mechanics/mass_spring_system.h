// The points and springs of one island with its force generators, as the second-order system that methods integrate.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/mechanics/dashpot_sweep.h"
#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/spring_kernels.h"
#include "taut/mechanics/spring_network.h"
#include "taut/mechanics/spring_products.h"
#include "taut/ode/system.h"

namespace taut::mechanics {

// Kinematic points: `path` writes the position and velocity of each at t [s], in their order [m, m/s]. The system calls
// it for every time at which a method wants forces, also for stages within a step. It must give the same answer for the
// same t.
struct LedPoints {
    std::vector<int> points;
    std::function<void(double t, std::span<glm::dvec3> x, std::span<glm::dvec3> v)> path;
};

// A point that moves faster than this [m/s] has diverged.
inline constexpr double speedLimit = 3000.0;

struct PointMass {
    double mass;      // [kg] > 0, with the air
    double dragRate;  // γ/m [1/s]
    bool held;
    double airMass = 0;  // [kg] of air that goes along: it has inertia and no weight

    double weighedMass() const { return mass - airMass; }
};

template <class Real>
class MassSpringSystem final : public ode::SecondOrderSystem<Real>,
                               public ode::ImplicitSystem<Real>,
                               public ode::SplitSystem<Real> {
  public:
    using PointMass = mechanics::PointMass;
    using Body = PointRange;

    // Bodies give the first point and row length of each body, ascending from point 0. Springs name points by number;
    // expects those to exist.
    MassSpringSystem(std::span<const PointMass> points, std::span<const Body> bodies, std::span<const Spring> springs);
    explicit MassSpringSystem(const Model& model);  // of a single body

    // Adds a generator, not null. Generators act in the order of adding.
    void add(std::unique_ptr<ForceGenerator<Real>> generator);
    std::span<const std::unique_ptr<ForceGenerator<Real>>> generators() const { return generators_; }
    void removeGenerators(std::size_t from = 0);  // this one and those after it

    // Both take effect when the method is started again. They expect as many points or springs as before, and springs
    // between the same points. setPoints() ends the motions of lead().
    void setPoints(std::span<const PointMass> points);
    void setSprings(std::span<const Spring> springs);
    // Takes over stiffness and rest length of these springs only, from the next evaluation on. Expects springs as
    // setSprings() does.
    void changeSprings(std::span<const int> which, std::span<const Spring> springs);

    // Moves points along given paths. Expects held points, each once. Takes effect when the method is started, or
    // started again.
    void lead(LedPoints led);
    void prescribe(double t, Real* x, Real* v) override;

    ode::Layout layout() const override { return layout_; }
    const Real* dragRates() const override { return drag_.data(); }
    void accelerate(double t, const Real* x, const Real* v, ode::AccelerationSink<Real>& sink) override;

    // The forces of the springs, without the part that compression makes indefinite, and of the generators as they
    // document.
    ode::ImplicitSystem<Real>* implicitPart() override { return this; }
    void linearise(double t, const Real* x, const Real* v, double stiffness, double damping) override;
    void addProduct(const Real* u, Real* out) const override;
    void addDiagonal(Real* out) const override;

    // The dashpots, one after the other; see dashpot_sweep.h.
    ode::SplitSystem<Real>* splitPart() override { return this; }
    void split(bool isSplit) override;
    void dampBefore(double h, const Real* x, Real* v) override { sweep_.before(damped_, points(x, v), h); }
    void dampBetween(const Real* x, Real* v) override { sweep_.between(points(x, v)); }
    void dampAfter(const Real* x, Real* v) override { sweep_.after(damped_, points(x, v)); }
    void shareOut(double t, Real* v) override {
        if (shareOut_) shareOut_(t, v);
    }
    // The effect of constraints on velocities after a kick, see ode::SplitSystem.
    void setShareOut(std::function<void(double t, Real* v)> shareOut) { shareOut_ = std::move(shareOut); }
    double largestPairRate() { return sweep_.largestPairRate(network(), inverseMass_.data()); }

    // The motion that generators get: x and v (layout().size()) [m], [m/s] are not copied.
    Motion<Real> motion(double t, const Real* x, const Real* v) const;
    const Real* masses() const override { return mass_.data(); }
    const Real* inverseMasses() const override { return inverseMass_.data(); }
    // Counts all dashpots, split off or not.
    const SpringNetwork<Real>& network() const { return isSplit_ ? damped_ : network_; }
    std::uint64_t bytes() const;  // memory that it takes

  private:
    // The forces of the points around a sweep: from the current block to the furthest point that a spring has reached.
    struct Window {
        int first = 0;               // point at its start
        int room = 0;                // points
        core::AlignedArray<Real> f;  // (3 · room) [N]
        Real* at(int plane, int point) {
            return f.data() + static_cast<std::ptrdiff_t>(plane) * room + (point - first);
        }
        // Keeps points begin … end - 1, moved to the start.
        void slide(int begin, int end) {
            for (int p = 0; p < 3; ++p) std::copy(at(p, begin), at(p, end), at(p, first));
            first = begin;
        }
    };
    // The scratch of one chunk's sweep.
    struct Lane {
        Window window;   // after the sweep: contributions of the chunk to the next
        Window waiting;  // forces of the first blocks, which wait for the spill of the chunk before
        int blocksWaiting = 0;
        // Where single springs are many: points of the window point by point, as PackedSpringArgs has them.
        core::AlignedArray<Real> state = {}, force = {};
        bool isPacked() const { return state.size() > 0; }
    };

    typename DashpotSweep<Real>::Points points(const Real* x, Real* v) const {
        return {layout_.stride, inverseMass_.data(), x, v};
    }
    void layOutLanes();
    void sweep(std::size_t chunk, const Motion<Real>& now, ode::AccelerationSink<Real>& sink);
    void moveOn(Lane& lane, const SpringBlock& block, const Motion<Real>& now, int& reach);
    void applySprings(const SpringBlock& block, const Motion<Real>& now, Lane& lane);
    void unpack(Lane& lane, int first, int last);
    void takeSpill(std::size_t chunk, const Motion<Real>& now, ode::AccelerationSink<Real>& sink);
    void finish(const SpringBlock& block, const Motion<Real>& now, Window& window, ode::AccelerationSink<Real>& sink);

    ode::Layout layout_;
    core::AlignedArray<Real> mass_, inverseMass_, drag_;  // (stride)
    core::AlignedArray<Real> external_;                   // (3 · stride) forces of generators; empty without any
    SpringNetwork<Real> network_;
    std::vector<Lane> lanes_;  // (chunks)
    std::vector<std::unique_ptr<ForceGenerator<Real>>> generators_;
    struct KinematicPoints {
        LedPoints led;
        std::vector<glm::dvec3> x, v;  // (points of led) last positions of path
    };
    std::vector<KinematicPoints> kinematic_;
    bool isExternalFilled_ = false;  // in this evaluation, by generators that need the whole island
    Real uniform_[3] = {};           // acceleration of all free points in this evaluation [m/s²]
    SpringKernels<Real> kernels_;
    SpringProducts<Real> products_;
    DashpotSweep<Real> sweep_;
    std::function<void(double t, Real* v)> shareOut_;
    bool isSplit_ = false;
    SpringNetwork<Real> damped_;  // once split: with the dashpots, which network_ is then without
};

}  // namespace taut::mechanics
