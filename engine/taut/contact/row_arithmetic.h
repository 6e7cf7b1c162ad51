// Relative velocity and impulse of a row, for one row at a time; gauss_seidel_kernel.cpp does so for four.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <span>

#include "taut/contact/gauss_seidel.h"
#include "taut/core/across.h"

namespace taut::contact {

using core::acrossOf;
using glm::dvec3;

inline Four four(const dvec3& v) {
    return {{v.x, v.y, v.z, 0}};
}
inline dvec3 vectorOf(const Four& v) {
    return {v.of[0], v.of[1], v.of[2]};
}

inline dvec3 armOf(const Turn& turn) {
    return {turn.arm[0], turn.arm[1], turn.arm[2]};
}
inline glm::dmat3 gainOf(const Turn& turn) {
    glm::dmat3 gain;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) gain[j][i] = turn.gain[3 * i + j];
    return gain;
}

// Friction, no more of it than Coulomb allows.
inline dvec3 withinCone(const dvec3& friction, double limit) {
    const double size = std::sqrt(glm::dot(friction, friction));
    return size > limit ? friction * (limit / size) : friction;
}

// [m/s] of the first side from the second.
inline dvec3 relativeVelocity(const Row& row, std::span<const Four> velocities, const Levers& levers) {
    const auto at = [&](int slot) { return vectorOf(velocities[static_cast<std::size_t>(slot)]); };
    dvec3 sum(0.0);
    for (std::size_t k = 0; k < 4; ++k) sum += row.weights[k] * at(row.slots[k]);
    for (const Turn& turn : row.turns.of(levers.turns)) sum += glm::cross(at(turn.slot), armOf(turn));
    for (const Share& share : row.shares.of(levers.shares)) sum += share.weight * at(share.slot);
    return sum;
}

// Gives the row an impulse [N s].
inline void push(const Row& row, const dvec3& impulse, std::span<Four> velocities, const Levers& levers) {
    const auto add = [&](int slot, const dvec3& change) {
        for (int i = 0; i < 3; ++i) velocities[static_cast<std::size_t>(slot)].of[i] += change[i];
    };
    for (std::size_t k = 0; k < 4; ++k) add(row.slots[k], row.gains[k] * impulse);
    for (const Turn& turn : row.turns.of(levers.turns)) add(turn.slot, gainOf(turn) * glm::cross(armOf(turn), impulse));
    for (const Share& share : row.shares.of(levers.shares)) add(share.slot, share.gain * impulse);
}

}  // namespace taut::contact
