// The points and springs of one island with its force generators, as the second-order system that methods integrate.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/aligned_array.h"
#include "mechanics/force_generator.h"
#include "mechanics/spring_kernels.h"
#include "mechanics/spring_network.h"
#include "ode/system.h"

namespace taut::mechanics {

template <class Real>
class MassSpringSystem final : public ode::SecondOrderSystem<Real> {
  public:
    struct PointMass {
        double mass;      // [kg] > 0
        double dragRate;  // γ/m [1/s]
        bool held;
    };
    using Body = typename SpringNetwork<Real>::Body;

    // Bodies give the first point and row length of each body, ascending from point 0.
    MassSpringSystem(std::span<const PointMass> points, std::span<const Body> bodies, std::span<const Spring> springs);

    // Adds a generator; they act in the order of adding.
    void add(std::unique_ptr<ForceGenerator<Real>> generator);
    std::span<const std::unique_ptr<ForceGenerator<Real>>> generators() const { return generators_; }

    ode::Layout layout() const override { return layout_; }
    const Real* dragRates() const override { return drag_.data(); }
    void accelerate(double t, const Real* x, const Real* v, ode::AccelerationSink<Real>& sink) override;

    Motion<Real> motion(double t, const Real* x, const Real* v) const;
    const Real* masses() const { return mass_.data(); }
    const Real* inverseMasses() const { return inverseMass_.data(); }
    const SpringNetwork<Real>& network() const { return network_; }
    std::uint64_t bytes() const;

  private:
    void sweep(const SpringChunk& chunk, bool prefilled, const Motion<Real>& motion, ode::AccelerationSink<Real>& sink);
    void applySprings(const SpringChunk& chunk, const SpringBlock& block, const Motion<Real>& motion);
    void takeSpill(std::size_t chunk, const Motion<Real>& motion, ode::AccelerationSink<Real>& sink);
    void finish(const SpringBlock& block, const Motion<Real>& motion, ode::AccelerationSink<Real>& sink);

    ode::Layout layout_;
    core::AlignedArray<Real> mass_, inverseMass_, drag_;  // (stride)
    core::AlignedArray<Real> force_;                      // (3 · stride)
    SpringNetwork<Real> network_;
    std::vector<core::AlignedArray<Real>> spill_;    // (chunks) (3 · spill)
    std::vector<core::AlignedArray<Real>> scratch_;  // (chunks) (3 · longest run)
    std::vector<int> deferred_;                      // (chunks) blocks at its start that wait for the spill
    std::vector<std::unique_ptr<ForceGenerator<Real>>> generators_;
    SpringKernels<Real> kernels_;
};

}  // namespace taut::mechanics
