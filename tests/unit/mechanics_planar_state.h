// Planar points for a force generator under test, filled from a model.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/core/private/instruction_set.h"
#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/model.h"

namespace taut::mechanics::test {

inline glm::dvec3 sum(const std::vector<glm::dvec3>& vectors) {
    glm::dvec3 total(0.0);
    for (const glm::dvec3& v : vectors) total += v;
    return total;
}

template <class Real>
class PlanarState {
  public:
    PlanarState(std::span<const glm::dvec3> positions, std::span<const double> masses)
        : count(static_cast<int>(positions.size())),
          stride((count + 15) / 16 * 16),
          x(planes()),
          v(planes()),
          f(planes()),
          mass(static_cast<std::size_t>(stride)),
          inverseMass(static_cast<std::size_t>(stride)) {
        for (int i = 0; i < count; ++i) {
            const auto p = static_cast<std::size_t>(i);
            set(x, i, positions[p]);
            mass[p] = static_cast<Real>(masses[p]);
            inverseMass[p] = static_cast<Real>(1.0 / masses[p]);
        }
    }
    explicit PlanarState(const Model& model) : PlanarState(model.positions, model.masses) {}

    void set(core::AlignedArray<Real>& array, int i, const glm::dvec3& value) const {
        for (int axis = 0; axis < 3; ++axis) array[index(i, axis)] = static_cast<Real>(value[axis]);
    }
    glm::dvec3 get(const core::AlignedArray<Real>& array, int i) const {
        return {array[index(i, 0)], array[index(i, 1)], array[index(i, 2)]};
    }
    std::size_t index(int i, int axis) const { return static_cast<std::size_t>(axis * stride + i); }
    std::size_t planes() const { return static_cast<std::size_t>(3 * stride); }

    Motion<Real> motion(double t = 0.0) const {
        return {count, stride, t, x.data(), v.data(), mass.data(), inverseMass.data()};
    }

    // (points) force of a generator [N].
    std::vector<glm::dvec3> forces(const ForceGenerator<Real>& generator, double t = 0.0) {
        std::fill(f.begin(), f.end(), Real(0));
        generator.addForces(motion(t), 0, count, f.data());
        std::vector<glm::dvec3> forces;
        for (int i = 0; i < count; ++i) forces.push_back(get(f, i));
        return forces;
    }

    // Moves every coordinate, and gives every velocity, a repeatable amount of -size … size.
    void shake(double size, double speed) {
        std::uint32_t state = 12345;
        auto next = [&state] {
            state = state * 1664525U + 1013904223U;
            return (static_cast<double>(state >> 8) / 0x800000) - 1.0;
        };
        for (int i = 0; i < count; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                x[index(i, axis)] += static_cast<Real>(size * next());
                v[index(i, axis)] += static_cast<Real>(speed * next());
            }
    }

    StabilityShare stability(const ForceGenerator<Real>& generator) const {
        StabilityShare share{std::vector<double>(static_cast<std::size_t>(count), 0.0),
                             std::vector<double>(static_cast<std::size_t>(count), 0.0)};
        generator.addStability(motion(), share);
        return share;
    }

    int count, stride;
    core::AlignedArray<Real> x, v, f, mass, inverseMass;
};

// Runs with each instruction set that the processor has, then puts back the one in use.
template <class Visit>
void forEachInstructionSet(Visit visit) {
    const core::InstructionSet before = core::instructionSet();
    for (core::InstructionSet set :
         {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512}) {
        if (!core::isSupported(set)) continue;
        core::useInstructionSet(set);
        visit();
    }
    core::useInstructionSet(before);
}

}  // namespace taut::mechanics::test
