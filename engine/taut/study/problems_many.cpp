// Problems of many point masses: linear ones with known modes, and cloths.
#include <array>
#include <cmath>
#include <numbers>

#include "taut/mechanics/builders.h"
#include "taut/study/mechanical_subject.h"
#include "taut/study/problems.h"

namespace taut::study {
namespace {

using glm::dvec3;
using std::numbers::pi;

mechanics::Model pointsAt(const std::vector<dvec3>& positions, double mass) {
    mechanics::Model model;
    model.positions = positions;
    model.velocities.assign(positions.size(), dvec3(0.0));
    model.masses.assign(positions.size(), mass);
    model.dragRates.assign(positions.size(), 0.0);
    model.held.assign(positions.size(), false);
    model.uv.assign(positions.size(), glm::dvec2(0.0));
    return model;
}

constexpr int clothCells = 16;

// One metre of light cotton, released at rest. A slight smooth bulge breaks the symmetry that would hide its chaos.
std::unique_ptr<Subject> cloth(const char* name, const char* title, const char* hold, const dvec3& down) {
    mechanics::ClothShape shape;
    shape.cells = {clothCells, clothCells};
    shape.down = down;
    shape.material = {.density = 0.2, .stretch = 900, .shear = 450, .bend = 1, .dampingTime = 1e-4, .dragRate = 0.3};
    MechanicalProblem problem;
    problem.name = name;
    problem.title = title;
    problem.duration = 0.5;
    problem.model = mechanics::buildCloth(shape);
    mechanics::Model& model = problem.model;
    const std::string which(hold);
    for (const char* group : {"top", "left", "top-left", "top-right"})
        if (which.find(std::string("(") + group + ")") != std::string::npos)
            for (const int i : model.groups.at(group)) model.held[i] = true;
    const dvec3 normal = glm::normalize(glm::cross(shape.across, shape.down));
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        const double u = model.uv[i].x, w = model.uv[i].y;
        const double bulge = 0.01 * std::sin(pi * w) * (0.6 + std::sin(2.3 * pi * u + 0.4));
        if (!model.held[i]) model.positions[i] += bulge * normal;
    }
    return makeMechanicalSubject(std::move(problem));
}

}  // namespace

// Sixteen masses of 0.1 kg between walls, springs of 400 N/m, all along x and never slack: longitudinal motion is
// exactly linear. Mode j: sin(j i π/(n+1)) cos ω_j t, ω_j = 2 √(k/m) sin(jπ/2(n+1)).
std::unique_ptr<Subject> makeChain() {
    constexpr int n = 16;
    constexpr double mass = 0.1, stiffness = 400, spacing = 0.1;
    constexpr std::array<int, 3> modes = {1, 4, 11};
    constexpr std::array<double, 3> amplitudes = {0.02, 0.006, 0.003};  // [m] together too little to cross over
    std::vector<dvec3> rest;
    for (int i = 0; i <= n + 1; ++i) rest.emplace_back(spacing * i, 0.0, 0.0);
    MechanicalProblem problem;
    problem.name = "chain";
    problem.title = "Chain of 16 masses, modes 1, 4 and 11";
    problem.duration = 1;
    problem.gravity = dvec3(0.0);
    problem.model = pointsAt(rest, mass);
    problem.model.held.front() = problem.model.held.back() = true;
    for (int i = 0; i <= n; ++i) problem.model.springs.push_back({i, i + 1, stiffness, spacing, 0.0});
    problem.solution = [=](double t, std::span<dvec3> x, std::span<dvec3> v) {
        for (int i = 1; i <= n; ++i) {
            const auto at = static_cast<std::size_t>(i);
            x[at] = rest[at];
            v[at] = dvec3(0.0);
            for (std::size_t j = 0; j < modes.size(); ++j) {
                const double omega = 2 * std::sqrt(stiffness / mass) * std::sin(modes[j] * pi / (2 * (n + 1)));
                const double shape = amplitudes[j] * std::sin(modes[j] * i * pi / (n + 1));
                x[at].x += shape * std::cos(omega * t);
                v[at].x -= shape * omega * std::sin(omega * t);
            }
        }
    };
    std::vector<dvec3> v(rest.size(), dvec3(0.0));
    problem.solution(0.0, problem.model.positions, v);
    return makeMechanicalSubject(std::move(problem));
}

// 8 × 8 masses in a square frame; springs of zero rest length under the tension T = k ℓ are exactly linear, so that the
// modes hold at any amplitude: ω²_pq = (4T/mℓ)[sin²(pπ/2(n+1)) + sin²(qπ/2(n+1))].
std::unique_ptr<Subject> makeNet() {
    constexpr int n = 8, side = n + 2;
    constexpr double mass = 0.02, stiffness = 50, spacing = 0.1;
    constexpr std::array<std::array<int, 2>, 3> modes = {{{1, 1}, {2, 3}, {6, 5}}};
    constexpr std::array<double, 3> amplitudes = {0.05, 0.02, 0.01};  // [m]
    std::vector<dvec3> rest;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) rest.emplace_back(spacing * i, 0.0, spacing * j);
    MechanicalProblem problem;
    problem.name = "net";
    problem.title = "Square net of 8 × 8 masses under tension, modes (1,1), (2,3) and (6,5)";
    problem.duration = 1;
    problem.gravity = dvec3(0.0);
    problem.model = pointsAt(rest, mass);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const int at = j * side + i;
            problem.model.held[at] = i == 0 || j == 0 || i == side - 1 || j == side - 1;
            if (i + 1 < side && j > 0 && j + 1 < side) problem.model.springs.push_back({at, at + 1, stiffness, 0.0});
            if (j + 1 < side && i > 0 && i + 1 < side) problem.model.springs.push_back({at, at + side, stiffness, 0.0});
        }
    problem.solution = [=](double t, std::span<dvec3> x, std::span<dvec3> v) {
        for (int j = 1; j <= n; ++j)
            for (int i = 1; i <= n; ++i) {
                const auto at = static_cast<std::size_t>(j * side + i);
                x[at] = rest[at];
                v[at] = dvec3(0.0);
                for (std::size_t m = 0; m < modes.size(); ++m) {
                    const double p = modes[m][0] * pi / (n + 1), q = modes[m][1] * pi / (n + 1);
                    const double omega = 2 * std::sqrt(stiffness / mass) * std::hypot(std::sin(p / 2), std::sin(q / 2));
                    const double shape = amplitudes[m] * std::sin(p * i) * std::sin(q * j);
                    x[at].y += shape * std::cos(omega * t);
                    v[at].y -= shape * omega * std::sin(omega * t);
                }
            }
    };
    std::vector<dvec3> v(rest.size(), dvec3(0.0));
    problem.solution(0.0, problem.model.positions, v);
    return makeMechanicalSubject(std::move(problem));
}

std::unique_ptr<Subject> makeClothTop() {
    return cloth("cloth-top", "Hanging cloth, 16 × 16 cells, top row held", "(top)",
                 glm::normalize(dvec3(0.0, -1.0, 0.5)));
}
std::unique_ptr<Subject> makeClothCorners() {
    return cloth("cloth-corners", "Hanging cloth, 16 × 16 cells, two corners held", "(top-left)(top-right)",
                 glm::normalize(dvec3(0.0, -1.0, 0.5)));
}
std::unique_ptr<Subject> makeClothEdge() {
    return cloth("cloth-edge", "Falling cloth, 16 × 16 cells, one edge held", "(left)", dvec3(0.0, 0.0, 1.0));
}

}  // namespace taut::study
