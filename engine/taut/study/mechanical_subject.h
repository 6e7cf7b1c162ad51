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

// The problems with point masses; a row of problems.cpp names each.
std::unique_ptr<Subject> makeProjectile();
std::unique_ptr<Subject> makeOscillator(const char* name, const char* title, double dampingRatio);
std::unique_ptr<Subject> makePendulum();
std::unique_ptr<Subject> makeChain();
std::unique_ptr<Subject> makeNet();
std::unique_ptr<Subject> makeCloth(const char* name, const char* title, const std::vector<std::string>& hold,
                                   const glm::dvec3& down);
// Adds a point at rest and returns its number.
int addPoint(mechanics::Model& model, const glm::dvec3& position, double mass, bool isHeld);

}  // namespace taut::study
