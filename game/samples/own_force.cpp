// A force of one's own, a well that draws a spinning rope to the origin; its energy strays by h²: own_force [h in s].
#include <cmath>
#include <cstdio>

#include "taut/bodies/rope.h"
#include "taut/forces/force.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

using namespace taut;

// F = -ω² m x, U = ω² m x²/2 on the points of an island. Arrays are planes: x of all points, then y, then z.
template <class Real>
struct Pull final : mechanics::ForceGenerator<Real> {
    using Motion = mechanics::Motion<Real>;
    static Real stiffness(const Motion& now, int i) { return Real(9.0) * now.mass[i]; }  // ω² m [N/m]
    void addForces(const Motion& now, int first, int last, Real* f) const override {
        for (int plane : {0, now.stride, 2 * now.stride})
            for (int i = first; i < last; ++i) f[plane + i] -= stiffness(now, i) * now.x[plane + i];
    }
    double potentialEnergy(const Motion& now, const std::vector<bool>& only) const override {
        double sum = 0.0;
        for (int plane : {0, now.stride, 2 * now.stride})
            for (int i = 0; i < now.count; ++i)
                if (only.empty() || only[i]) sum += 0.5 * stiffness(now, i) * now.x[plane + i] * now.x[plane + i];
        return sum;
    }
    void addStiffnessProduct(const Motion& now, const Real* u, Real* out) const override {  // -∂F/∂x u
        for (int plane : {0, now.stride, 2 * now.stride})
            for (int i = 0; i < now.count; ++i) out[plane + i] += stiffness(now, i) * u[plane + i];
    }
    void addStability(const Motion& now, mechanics::StabilityShare& share) const override {  // steps are chosen by this
        for (int i = 0; i < now.count; ++i) share.stiffness[i] += stiffness(now, i);
    }
};

struct Well final : world::ForceOf<Well> {
    Well() : ForceOf("well.deep") {}
    template <class Real>
    auto make(const world::IslandPlan&) const {
        return std::make_unique<Pull<Real>>();
    }
};

int main(int count, char** arguments) {
    world::SceneSpec scene;
    scene.solver.precision = world::Precision::double_;
    scene.solver.dt = count > 1 ? std::stod(arguments[1]) : 1e-3;
    world::RopeSpec rope;  // from the origin a metre along x, of 1 kg
    rope.name = "rope";
    rope.stretch = 100.0;
    rope.spin = {0.0, 0.0, 6.0};
    rope.drag = rope.dampingTime = 0.0;
    scene.bodies.add(rope);

    world::World world(scene, {.forces = {std::make_shared<Well>()}});
    const auto energy = [](const world::Metrics& m) { return m.kinetic + m.elastic + m.gravitational; };
    double start = energy(world.metrics()), worst = 0.0;  // the well's energy is among the elastic
    for (; world.time() < 2.0; worst = std::fmax(worst, std::abs(energy(world.metrics()) - start)))
        if (world.advance()) return 1;
    std::printf("%.6f J, never more than %.3e J away from it\n", start, worst);
}
