// Point masses and springs as a subject: a model, gravity, and its theory. Independent of scene files.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "taut/mechanics/model.h"
#include "taut/study/subject.h"

namespace taut::study {

// Fills positions [m] and velocities [m/s] of all points at t [s].
using Solution = std::function<void(double t, std::span<glm::dvec3> x, std::span<glm::dvec3> v)>;

struct MechanicalProblem {
    std::string name, title;
    double duration = 1;  // [s]
    mechanics::Model model;
    glm::dvec3 gravity{0.0, -9.81, 0.0};  // [m/s²]
    Solution solution;                    // empty: none in closed form
};

std::unique_ptr<Subject> makeMechanicalSubject(MechanicalProblem problem);

// ½ m v² and springs and gravity of a model at these positions and velocities [J].
struct Energies {
    double kinetic = 0, potential = 0;
};
Energies energiesOf(const mechanics::Model& model, const glm::dvec3& gravity, std::span<const glm::dvec3> x,
                    std::span<const glm::dvec3> v);

}  // namespace taut::study
