// A step that follows the state: it takes no energy out and puts none in, and the method keeps its order over a change.
#include <gtest/gtest.h>

#include <cmath>

#include "support/network.h"
#include "taut/bodies/net.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut::test::step_following {
namespace {

// A tetrahedron of springs, stretched by a fiftieth and released, that spins in space without any damping.
world::SceneSpec spinningNet(double stiffness) {
    world::SceneSpec scene;
    scene.solver.precision = world::Precision::double_;
    scene.world.gravity = dvec3(0.0);
    world::NetSpec net;
    net.name = "top";
    net.drag = 0;
    net.spin = {0.3, 2.0, 0.5};
    net.points = {{"a", {1, 1, 1}, 1.0, false, {}},
                  {"b", {1, -1, -1}, 1.0, false, {}},
                  {"c", {-1, 1, -1}, 2.0, false, {}},
                  {"d", {-1, -1, 1}, 0.5, false, {}}};
    const double rest = 0.98 * std::sqrt(8.0);
    for (const char* ends : {"ab", "ac", "ad", "bc", "bd", "cd"})
        net.springs.push_back({std::string(1, ends[0]), std::string(1, ends[1]), stiffness, rest, {}, {}});
    scene.bodies.add(net);
    return scene;
}

// Of a mode leap-frog keeps an energy that differs from the true one by up to z²/4, now more and now less: the mean
// over many periods tells a trend. A switch at every change of the bound lost 44 % in 25 s.
TEST(StepFollowing, ASpinningNetKeepsItsEnergyForAMillionSteps) {
    for (const auto& [stiffness, substeps] : {std::pair(2e3, 2), std::pair(2e5, 20), std::pair(4e7, 200)}) {
        world::World world(spinningNet(stiffness));
        EXPECT_NEAR(world.islands()[0].substeps, substeps, 0.5 * substeps);
        const auto ticks = static_cast<std::int64_t>(1e6 / world.islands()[0].substeps);
        double early = 0, late = 0;
        const std::int64_t window = ticks / 10, every = std::max<std::int64_t>(1, window / 2000);
        for (std::int64_t tick = 0; tick < ticks; ++tick) {
            ASSERT_FALSE(world.advance());
            if (tick % every != 0) continue;
            if (tick < window) early += world.metrics().energy();
            if (tick >= ticks - window) late += world.metrics().energy();
        }
        EXPECT_NEAR(late / early, 1.0, 1e-3)
            << substeps << " substeps, " << world.islands()[0].stepChanges.size() << " changes of step";
    }
}

// Two masses between walls, damped; the step changes by a third halfway. Refined twice, the error falls fourfold twice.
double errorWithChange(double h, bool splits) {
    mechanics::Model model;
    for (int i = 0; i < 4; ++i) addPoint(model, {static_cast<double>(i), 0, 0}, 0.7, i == 0 || i == 3);
    for (int i = 0; i < 3; ++i) addSpring(model, i, i + 1, 50.0, 0.9, 0.02);
    model.positions[1].x += 0.1;
    const auto play = [&](double step, std::string_view method, bool split) {
        mechanics::MassSpringSystem<double> system(model);
        ode::State<double> state(system.layout());
        for (int i = 0; i < 4; ++i) state.x[i] = model.positions[i].x;
        ode::MethodOptions options;
        options.splits = split;
        const auto run = ode::makeMethod<double>(method, options);
        double t = 0;
        for (const double h1 : {step, 2 * step / 3}) {
            run->start(system, t, h1, state);
            const auto steps = static_cast<int>(std::llround(1.0 / h1));
            for (int n = 0; n < steps; ++n) run->step(system, t + n * h1, h1, state);
            t += 1.0;
            core::AlignedArray<double> v(state.v.size());
            run->synchronise(system, t, h1, state, v.data());
            state.v = v;
        }
        return dvec3(state.x[1], state.x[2], state.v[1]);
    };
    static const dvec3 truth = play(1.0 / 30000, "rk4", false);
    return glm::length(play(h, "leapfrog", splits) - truth);
}

TEST(StepFollowing, IsOfSecondOrderOverAChangeOfStep) {
    for (bool splits : {false, true}) {
        const double coarse = errorWithChange(1.0 / 100, splits), middle = errorWithChange(1.0 / 200, splits),
                     fine = errorWithChange(1.0 / 400, splits);
        EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.15) << splits;
        EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.1) << splits;
    }
}

}  // namespace
}  // namespace taut::test::step_following
