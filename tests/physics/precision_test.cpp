// Single against double precision: the same scene stays together for as long as rounding allows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/forces/wind.h"

namespace taut::test::precision {
namespace {

world::SceneSpec sheet(world::Precision precision, const char* method) {
    world::SceneSpec scene;
    scene.solver.precision = precision;
    scene.solver.integrator = method;
    scene.materials["cotton"] = {0.2, 500.0, 250.0, 2.0, 2e-4, 0.5, mechanics::Lumping::weighted, {}};
    world::ClothSpec cloth;
    cloth.name = "sheet";
    cloth.material = "cotton";
    cloth.size = {1.0, 0.8};
    cloth.cells = {20, 16};
    cloth.origin = {-0.5, 1.0, 0.0};
    cloth.down = {0.0, -0.6, 0.8};
    cloth.hold = {"top"};
    scene.bodies.add(cloth);
    world::WindSpec wind;
    wind.name = "breeze";
    wind.velocity = {1.0, 0.0, 4.0};
    wind.gustAmplitude = 1.0;
    scene.forces.add(wind);
    return scene;
}

// A quarter of a second, some 700 steps. Each rounds positions of 1 m by 3e-8 at random: 1e-6 m. Gravity adds v of 1
// m/s, rounded as well, which drifts by 3e-8 · √700 · 0.25 s: less. Ten times that is allowed for the springs that pass
// it on, and less than 1e-9 would mean that both ran in the same precision.
TEST(SinglePrecision, StaysWithDoubleForAQuarterOfASecond) {
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        SCOPED_TRACE(method);
        world::World one(sheet(world::Precision::single_, method)), two(sheet(world::Precision::double_, method));
        ASSERT_EQ(one.islands().front().substeps, two.islands().front().substeps);
        EXPECT_FALSE(advance(one, 15));
        EXPECT_FALSE(advance(two, 15));
        const std::vector<dvec3> x = positionsOf(one, "cloth.sheet"), y = positionsOf(two, "cloth.sheet");
        double square = 0.0, worst = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double off = glm::length(x[i] - y[i]);
            square += off * off / static_cast<double>(x.size());
            worst = std::max(worst, off);
        }
        EXPECT_LT(std::sqrt(square), 1e-5);
        EXPECT_LT(worst, 5e-5);
        EXPECT_GT(std::sqrt(square), 1e-9);
        EXPECT_GT(glm::length(y.back() - dvec3(0.5, 1.0 - 0.48, 0.64)), 0.1);  // it moved
    }
}

TEST(SinglePrecision, HasTheEnergyOfDouble) {
    world::World one(sheet(world::Precision::single_, "leapfrog")), two(sheet(world::Precision::double_, "leapfrog"));
    EXPECT_FALSE(advance(one, 15));
    EXPECT_FALSE(advance(two, 15));
    const world::Metrics a = one.metrics(), b = two.metrics();
    // Positions agree to 1e-5 m of 0.3 m of motion.
    EXPECT_NEAR(a.kinetic / b.kinetic, 1.0, 1e-4);
    EXPECT_NEAR(a.gravitational / b.gravitational, 1.0, 1e-4);
    // Strains are a few 1e-3, and 3e-8 m rounding on springs of 0.05 m is 1e-6 of strain.
    EXPECT_NEAR(a.elastic / b.elastic, 1.0, 1e-2);
}

world::SceneSpec chainAt(const dvec3& place, world::Precision precision, double dt) {
    world::SceneSpec scene;
    scene.solver.precision = precision;
    scene.solver.dt = dt;
    world::NetSpec net;
    net.name = "chain";
    net.points = {{"top", place, 0.1, true, {}}, {"end", place + dvec3(1.0, 0.0, 0.0), 0.1, false, {}}};
    net.springs = {{"top", "end", 100.0, {}, {}, {}}};
    scene.bodies.add(net);
    return scene;
}

bool saysThatItFreezes(const world::World& world, const std::string& name) {
    const std::vector<std::string> all = printed(world.warnings());
    return std::any_of(all.begin(), all.end(), [&](const std::string& warning) {
        return warning.starts_with(name + ": in single precision") && warning.find("\"double\"") != std::string::npos;
    });
}

// x + h v = x below v = ½ ulp(x)/h, at 2 m and 1e-7 s 1.2 m/s, at 4 km and 1e-3 s 0.24 m/s.
TEST(SinglePrecision, SaysWhereRoundingKeepsABodyInPlace) {
    using world::Precision;
    // From the start: at rest, for longer than the tick of 1/60 s that gives 0.16 m/s.
    EXPECT_TRUE(saysThatItFreezes(world::World(chainAt({0, 2.5, 0}, Precision::single_, 1e-7)), "net.chain"));
    EXPECT_FALSE(saysThatItFreezes(world::World(chainAt({0, 2.5, 0}, Precision::double_, 1e-7)), "net.chain"));
    EXPECT_FALSE(saysThatItFreezes(world::World(chainAt({0, 2.5, 0}, Precision::single_, 1e-4)), "net.chain"));

    // On the way: aside, 4 km from the origin, where a stretch of 1 mm gives it 1 m/s² and nothing moves for 0.24 s.
    world::SceneSpec aside = chainAt({4096.5, 1.5, 0}, Precision::single_, 1e-3);
    aside.bodies.of<world::NetSpec>()[0].springs[0].restLength = 0.999;
    aside.world.gravity = dvec3(0.0);
    world::World far(aside);
    EXPECT_FALSE(saysThatItFreezes(far, "net.chain"));
    EXPECT_FALSE(advance(far, 60));
    EXPECT_TRUE(saysThatItFreezes(far, "net.chain"));
}

}  // namespace
}  // namespace taut::test::precision
