// Problems of one point mass.
#include <cmath>

#include "taut/study/mechanical_subject.h"
#include "taut/study/problems.h"

namespace taut::study {
namespace {

using glm::dvec3;

// x'' + 2ζω x' + ω² x = 0 with x(0) = d, x'(0) = 0:
//   ζ < 1: e^{-at} [d cos ω_d t + (a d/ω_d) sin ω_d t], a = ζω, ω_d = √(ω² - a²); ζ = 1: e^{-at} d (1 + a t);
//   ζ > 1: cosh and sinh with √(a² - ω²), written as two decays so that nothing overflows.
void oscillation(double omega, double zeta, double d, double t, double& x, double& v) {
    const double a = zeta * omega;
    if (zeta < 1) {
        const double w = std::sqrt(omega * omega - a * a), decay = std::exp(-a * t);
        x = decay * d * (std::cos(w * t) + a / w * std::sin(w * t));
        v = -decay * d * omega * omega / w * std::sin(w * t);
    } else if (zeta == 1) {
        const double decay = std::exp(-a * t);
        x = decay * d * (1 + a * t);
        v = -decay * d * a * a * t;
    } else {
        const double w = std::sqrt(a * a - omega * omega), slow = a - w, fast = a + w;
        x = d * (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (2 * w);
        v = d * slow * fast * (std::exp(-fast * t) - std::exp(-slow * t)) / (2 * w);
    }
}

}  // namespace

int addPoint(mechanics::Model& model, const dvec3& position, double mass, bool isHeld) {
    model.positions.push_back(position);
    model.velocities.emplace_back(0.0);
    model.masses.push_back(mass);
    model.dragRates.push_back(0.0);
    model.held.push_back(isHeld);
    model.uv.emplace_back(0.0);
    return model.pointCount() - 1;
}

// A spring of zero rest length is exactly linear; 1 kg, ω = 6/s, so that no sample time falls on a turning point.
std::unique_ptr<Subject> makeOscillator(const char* name, const char* title, double zeta) {
    constexpr double omega = 6.0;
    const dvec3 start(1.0, 0.5, -0.25);
    MechanicalProblem problem;
    problem.name = name;
    problem.title = title;
    problem.duration = 5;
    problem.gravity = dvec3(0.0);
    const int wall = addPoint(problem.model, dvec3(0.0), 1.0, true);
    const int bob = addPoint(problem.model, start, 1.0, false);
    problem.model.dragRates[1] = 2 * zeta * omega;
    problem.model.springs.push_back({wall, bob, omega * omega, 0.0, 0.0});
    problem.solution = [=](double t, std::span<dvec3> x, std::span<dvec3> v) {
        for (int p = 0; p < 3; ++p) oscillation(omega, zeta, start[p], t, x[1][p], v[1][p]);
    };
    return makeMechanicalSubject(std::move(problem));
}

// v' = g - γ v: v = v_T + (v0 - v_T) e^{-γt}, v_T = g/γ.
std::unique_ptr<Subject> makeProjectile() {
    constexpr double drag = 0.8;
    const dvec3 launch(12.0, 15.0, -3.0);
    MechanicalProblem problem;
    problem.name = "projectile";
    problem.title = "A point mass thrown, with linear drag";
    problem.duration = 2;
    addPoint(problem.model, dvec3(0.0, 1.5, 0.0), 0.2, false);
    problem.model.velocities[0] = launch;
    problem.model.dragRates[0] = drag;
    problem.solution = [=, g = problem.gravity](double t, std::span<dvec3> x, std::span<dvec3> v) {
        const dvec3 terminal = g / drag;
        const double share = -std::expm1(-drag * t);  // 1 - e^{-γt}
        v[0] = launch + share * (terminal - launch);
        x[0] = dvec3(0.0, 1.5, 0.0) + terminal * t + (launch - terminal) * (share / drag);
    };
    return makeMechanicalSubject(std::move(problem));
}

// 1 kg on a string of 1 m and 40 N/m: ω_z = √(k/m) is about twice ω_x = √(g/l0), so that swinging and bouncing trade
// their energy. No closed form.
std::unique_ptr<Subject> makePendulum() {
    MechanicalProblem problem;
    problem.name = "pendulum";
    problem.title = "Elastic pendulum";
    problem.duration = 4;
    const int nail = addPoint(problem.model, dvec3(0.0), 1.0, true);
    const int bob = addPoint(problem.model, dvec3(0.6, -1.0, 0.2), 1.0, false);
    problem.model.springs.push_back({nail, bob, 40.0, 1.0, 0.0});
    return makeMechanicalSubject(std::move(problem));
}

}  // namespace taut::study
