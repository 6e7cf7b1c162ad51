// The fastest motion of a small network from the whole stiffness matrix: the reference for bounds and estimates.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>

#include "support/eigenvalues.h"
#include "taut/mechanics/model.h"

namespace taut::test {

// M^{-1/2} K M^{-1/2} at these positions, K = Σ k [(L/l) nnᵀ + (1 - L/l) I] over springs; held points leave zeros.
inline Matrix scaledStiffness(const mechanics::Model& model, std::span<const glm::dvec3> positions) {
    Matrix matrix(3 * model.positions.size());
    for (const mechanics::Spring& s : model.springs) {
        const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
        const glm::dvec3 d = positions[b] - positions[a];
        const double l = glm::length(d), wa = model.held[a] ? 0.0 : 1.0 / std::sqrt(model.masses[a]),
                     wb = model.held[b] ? 0.0 : 1.0 / std::sqrt(model.masses[b]);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double along = d[i] * d[j] / (l * l), same = i == j ? 1.0 : 0.0;
                const double k = s.stiffness * (along + (1.0 - s.restLength / l) * (same - along));
                const auto ai = 3 * a + static_cast<std::size_t>(i), aj = 3 * a + static_cast<std::size_t>(j);
                const auto bi = 3 * b + static_cast<std::size_t>(i), bj = 3 * b + static_cast<std::size_t>(j);
                matrix.at(ai, aj) += k * wa * wa;
                matrix.at(bi, bj) += k * wb * wb;
                matrix.at(ai, bj) -= k * wa * wb;
                matrix.at(bi, aj) -= k * wa * wb;
            }
    }
    return matrix;
}

// ω_max [1/s]; 0 when nothing is stiff.
inline double fastestFrequency(const mechanics::Model& model, std::span<const glm::dvec3> positions) {
    return std::sqrt(std::max(0.0, eigenvalues(scaledStiffness(model, positions)).back()));
}

}  // namespace taut::test
