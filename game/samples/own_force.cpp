// A force of one's own: two beads on a spring go round a sun. Spring and method are the engine's; that the force
// belongs to its potential energy shows in their sum, from which leap-frog strays by h² and no further: own_force [h in
// seconds].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "taut/mechanics/mass_spring_system.h"
#include "taut/ode/method_table.h"

using namespace taut;
using Motion = mechanics::Motion<double>;  // what a force may know: planes x…x y…y z…z, each `stride` long

const auto at = [](const double* a, int stride, int i) { return glm::dvec3(a[i], a[stride + i], a[2 * stride + i]); };

// U = -μ m/r, F = -μ m x/r³ about the origin, μ in m³/s².
struct Sun final : mechanics::ForceGenerator<double> {
    double mu = 10.0;
    std::string_view name() const override { return "sun"; }
    bool isLocal() const override { return true; }
    void addForces(const Motion& now, int first, int last, double* f) const override {
        for (int i = first; i < last; ++i) {
            const double k = mu * now.mass[i] / std::pow(glm::length(at(now.x, now.stride, i)), 3.0);
            for (int p = 0; p < 3; ++p) f[p * now.stride + i] -= k * now.x[p * now.stride + i];
        }
    }
    double potentialEnergy(const Motion& now) const override {
        double energy = 0.0;
        for (int i = 0; i < now.count; ++i) energy -= mu * now.mass[i] / glm::length(at(now.x, now.stride, i));
        return energy;
    }
    void addStiffnessProduct(const Motion&, const double*, double*) const override {}  // asked for by what finds steps,
    void addStability(const Motion&, mechanics::StabilityShare&) const override {}     // which is not used here
};

int main(int count, char** arguments) {
    const double h = count > 1 ? std::atof(arguments[1]) : 1e-3;  // [s]; stable below 0.06
    const mechanics::Spring spring{.a = 0, .b = 1, .stiffness = 500.0, .restLength = 0.1};
    mechanics::MassSpringSystem<double> system({{{1.0, 0.0, false}, {1.0, 0.0, false}}}, {{{0, 0}}}, {{spring}});
    system.add(std::make_unique<Sun>());

    ode::State<double> state(system.layout());
    const int stride = state.layout.stride;
    state.x[0] = 1.0, state.x[1] = 1.1;                // [m] along x
    state.v[stride] = 2.9, state.v[stride + 1] = 3.0;  // [m/s] along y
    const auto leapfrog = ode::makeMethod<double>("leapfrog");
    leapfrog->start(system, 0.0, h, state);
    double least = INFINITY, most = -INFINITY;
    for (int n = 0; n * h <= 10.0; leapfrog->step(system, n * h, h, state), ++n) {
        std::vector<double> v(state.v.size());  // at n h, where leap-frog keeps those half a step before
        leapfrog->synchronise(system, n * h, h, state, v.data());
        const Motion now = system.motion(n * h, state.x.data(), v.data());
        const double stretch = glm::distance(at(now.x, stride, 0), at(now.x, stride, 1)) - spring.restLength;
        double energy = system.generators()[0]->potentialEnergy(now) + 0.5 * spring.stiffness * stretch * stretch;
        for (int i = 0; i < 2; ++i) energy += 0.5 * glm::dot(at(now.v, stride, i), at(now.v, stride, i));
        least = std::min(least, energy), most = std::max(most, energy);
    }
    std::printf("energy between %.9f and %.9f J in 10 s\n", least, most);
}
