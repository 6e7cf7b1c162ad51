// The material properties of a network of springs, for the tests of the builders.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::mechanics::test {

inline const glm::dvec3& at(const std::vector<glm::dvec3>& vectors, int i) {
    return vectors[i];
}

inline double totalMass(const Model& model) {
    double sum = 0.0;
    for (double m : model.masses) sum += m;
    return sum;
}

inline glm::dvec3 centreOfMass(const Model& model) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < model.positions.size(); ++i) sum += model.masses[i] * model.positions[i];
    return sum / totalMass(model);
}

// Of the distances of its mass from the centre along each axis [m²].
inline glm::dvec3 meanSquares(const Model& model) {
    const glm::dvec3 centre = centreOfMass(model);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        const glm::dvec3 way = model.positions[i] - centre;
        sum += model.masses[i] * way * way;
    }
    return sum / totalMass(model);
}

// Σ k (n·ε d)²: twice the energy that a small uniform strain ε stores in the springs [J].
inline double strainEnergy(const Model& model, const glm::dmat3& strain) {
    double sum = 0.0;
    for (const Spring& s : model.springs) {
        const glm::dvec3 d = at(model.positions, s.b) - at(model.positions, s.a);
        const double stretch = glm::dot(glm::normalize(d), strain * d);
        sum += s.stiffness * stretch * stretch;
    }
    return sum;
}

// Stiffness between the axes i and j, C_ij with i != j, or C_ii, for a piece of this volume (or area) [Pa or N/m].
inline double normalStiffness(const Model& model, int i, int j, double size) {
    glm::dmat3 one(0.0), two(0.0);
    one[i][i] = 1.0;
    two[j][j] = 1.0;
    if (i == j) return strainEnergy(model, one) / size;
    return (strainEnergy(model, one + two) - strainEnergy(model, one) - strainEnergy(model, two)) / (2.0 * size);
}

// Stiffness against shear between the axes i and j.
inline double shearStiffness(const Model& model, int i, int j, double size) {
    glm::dmat3 strain(0.0);
    strain[i][j] = strain[j][i] = 0.5;
    return strainEnergy(model, strain) / size;
}

// (points) force of the springs under a small uniform strain, to first order in it [N].
inline std::vector<glm::dvec3> strainForces(const Model& model, const glm::dmat3& strain) {
    std::vector<glm::dvec3> forces(model.positions.size(), glm::dvec3(0.0));
    for (const Spring& s : model.springs) {
        const glm::dvec3 d = at(model.positions, s.b) - at(model.positions, s.a);
        const glm::dvec3 n = glm::normalize(d);
        const glm::dvec3 pull = s.stiffness * glm::dot(n, strain * d) * n;
        forces[s.a] += pull;
        forces[s.b] -= pull;
    }
    return forces;
}

// Every rule that holds for any model; empty if all hold, else the first that does not.
inline std::string brokenRule(const Model& model) {
    const std::size_t n = model.positions.size();
    if (model.velocities.size() != n || model.masses.size() != n || model.dragRates.size() != n ||
        model.held.size() != n || model.uv.size() != n)
        return "arrays differ in length";
    for (const glm::dvec3& p : model.positions)
        for (int axis = 0; axis < 3; ++axis)
            if (p[axis] == 0.0 && 1.0 / p[axis] < 0.0) return "a coordinate is -0";
    for (double m : model.masses)
        if (!(m > 0.0)) return "a mass is not positive";
    auto isPoint = [&](int i) { return i >= 0 && i < model.pointCount(); };
    for (const Spring& s : model.springs)
        if (!isPoint(s.a) || !isPoint(s.b) || s.a == s.b || !(s.stiffness >= 0.0) || !(s.restLength >= 0.0))
            return "a spring is not valid";
    for (const auto& [name, points] : model.groups) {
        if (points.empty() || !std::is_sorted(points.begin(), points.end())) return "group " + name;
        if (!isPoint(points.front()) || !isPoint(points.back())) return "group " + name;
    }
    if (!model.groups.contains("all") || model.groups.at("all").size() != n) return "group all";
    return "";
}

}  // namespace taut::mechanics::test
