// Problems of many point masses: linear ones with known modes, and cloths.
#include <cmath>
#include <numbers>

#include "taut/mechanics/builders.h"
#include "taut/study/mechanical_subject.h"
#include "taut/study/problems.h"

namespace taut::study {
namespace {

using glm::dvec3;
using std::numbers::pi;

// A network without gravity whose motion is a sum of modes: each point swings by its shape at the mode's frequency.
struct Mode {
    double omega;              // [rad/s]
    std::vector<dvec3> shape;  // (points) [m]
};

std::unique_ptr<Subject> linearNetwork(const char* name, const char* title, mechanics::Model model,
                                       std::vector<Mode> modes) {
    MechanicalProblem problem;
    problem.name = name;
    problem.title = title;
    problem.duration = 1;
    problem.gravity = dvec3(0.0);
    problem.solution = [rest = model.positions, modes = std::move(modes)](double t, std::span<dvec3> x,
                                                                          std::span<dvec3> v) {
        for (std::size_t i = 0; i < rest.size(); ++i) {
            x[i] = rest[i];
            v[i] = dvec3(0.0);
            for (const Mode& mode : modes) {
                x[i] += mode.shape[i] * std::cos(mode.omega * t);
                v[i] -= mode.shape[i] * mode.omega * std::sin(mode.omega * t);
            }
        }
    };
    std::vector<dvec3> v(model.positions.size(), dvec3(0.0));
    problem.solution(0.0, model.positions, v);
    problem.model = std::move(model);
    return makeMechanicalSubject(std::move(problem));
}

constexpr int clothCells = 16;

}  // namespace

// One metre of light cotton, released at rest. A slight smooth bulge breaks the symmetry that would hide its chaos.
std::unique_ptr<Subject> makeCloth(const char* name, const char* title, const std::vector<std::string>& hold,
                                   const dvec3& down) {
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
    for (const std::string& group : hold)
        for (const int i : model.groups.at(group)) model.held[i] = true;
    const dvec3 normal = glm::normalize(glm::cross(shape.across, shape.down));
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        const double u = model.uv[i].x, w = model.uv[i].y;
        const double bulge = 0.01 * std::sin(pi * w) * (0.6 + std::sin(2.3 * pi * u + 0.4));
        if (!model.held[i]) model.positions[i] += bulge * normal;
    }
    return makeMechanicalSubject(std::move(problem));
}

// Sixteen masses of 0.1 kg between walls, springs of 400 N/m, all along x and never slack: longitudinal motion is
// exactly linear. Mode j: sin(j i π/(n+1)) cos ω_j t, ω_j = 2 √(k/m) sin(jπ/2(n+1)).
std::unique_ptr<Subject> makeChain() {
    constexpr int n = 16;
    constexpr double mass = 0.1, stiffness = 400, spacing = 0.1;
    mechanics::Model model;
    for (int i = 0; i <= n + 1; ++i) addPoint(model, {spacing * i, 0.0, 0.0}, mass, i == 0 || i == n + 1);
    for (int i = 0; i <= n; ++i) model.springs.push_back({i, i + 1, stiffness, spacing, 0.0});
    std::vector<Mode> modes;
    // Together the amplitudes [m] are too little to cross over.
    for (const auto& [j, amplitude] : {std::pair(1, 0.02), {4, 0.006}, {11, 0.003}}) {
        Mode& mode = modes.emplace_back(Mode{2 * std::sqrt(stiffness / mass) * std::sin(j * pi / (2 * (n + 1))), {}});
        for (int i = 0; i <= n + 1; ++i)
            mode.shape.emplace_back(model.held[i] ? 0.0 : amplitude * std::sin(j * i * pi / (n + 1)), 0.0, 0.0);
    }
    return linearNetwork("chain", "Chain of 16 masses, modes 1, 4 and 11", std::move(model), std::move(modes));
}

// 8 × 8 masses in a square frame; springs of zero rest length under the tension T = k ℓ are exactly linear, so that the
// modes hold at any amplitude: ω²_pq = (4T/mℓ)[sin²(pπ/2(n+1)) + sin²(qπ/2(n+1))].
std::unique_ptr<Subject> makeNet() {
    constexpr int n = 8, side = n + 2;
    constexpr double mass = 0.02, stiffness = 50, spacing = 0.1;
    const auto isEdge = [](int i) { return i == 0 || i == side - 1; };
    mechanics::Model model;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) addPoint(model, {spacing * i, 0.0, spacing * j}, mass, isEdge(i) || isEdge(j));
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const int at = j * side + i;
            if (i + 1 < side && !isEdge(j)) model.springs.push_back({at, at + 1, stiffness, 0.0});
            if (j + 1 < side && !isEdge(i)) model.springs.push_back({at, at + side, stiffness, 0.0});
        }
    std::vector<Mode> modes;
    for (const auto& [waves, amplitude] : {std::pair(glm::dvec2(1, 1), 0.05), {{2, 3}, 0.02}, {{6, 5}, 0.01}}) {
        const double p = waves.x * pi / (n + 1), q = waves.y * pi / (n + 1);
        Mode& mode = modes.emplace_back(
            Mode{2 * std::sqrt(stiffness / mass) * std::hypot(std::sin(p / 2), std::sin(q / 2)), {}});
        for (int at = 0; at < side * side; ++at)
            mode.shape.emplace_back(
                0.0, model.held[at] ? 0.0 : amplitude * std::sin(p * (at % side)) * std::sin(q * (at / side)), 0.0);
    }
    return linearNetwork("net", "Square net of 8 × 8 masses under tension, modes (1,1), (2,3) and (6,5)",
                         std::move(model), std::move(modes));
}

}  // namespace taut::study
