// Whole energy, kinetic, elastic and of gravity, of bodies that touch: on impact and at rest.
#include "touching_scenes.h"

namespace taut::test::touching {
namespace {

using world::World;

world::BlockSpec block(const std::string& name, double size, const dvec3& position, double dampingTime) {
    world::BlockSpec block;
    block.name = name;
    block.size = dvec3(size);
    block.cells = {3, 3, 3};
    block.position = position;
    block.dampingTime = dampingTime;
    block.drag = 0.0;
    block.thickness = keep / 2;
    block.touch = world::Touch::all;
    return block;
}

// What is left after two springy blocks have met at 2 m/s, of the energy before; in steps of 1/128 of a tick.
double leftAfterImpact(std::optional<int> instants) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    spec.solver.dt = 1.0 / 60.0 / 128;
    spec.contact.instants = instants;
    spec.bodies.add(block("lower", 0.3, {0.0, 0.0, 0.01}, 0.0));
    spec.bodies.add(block("upper", 0.2, {0.0, 0.27, 0.01}, 0.0));
    spec.bodies.of<world::BlockSpec>()[0].velocity = {0.0, 1.0, 0.0};
    spec.bodies.of<world::BlockSpec>()[1].velocity = {0.0, -1.0, 0.0};
    spec.bodies.of<world::BlockSpec>()[1].rotation = {0.05, 0.3, 0.02};
    World world(spec);
    const double before = world.metrics().energy();
    EXPECT_FALSE(advance(world, 12));
    return world.metrics().energy() / before;
}

// Contact moves places as well as velocities, against springs, which an instant does not know of. What that adds falls
// with the length of an instant H, by its first power: 2 % at most where as many instants as a tick has by itself are
// held against a quarter of that length. Of four instants, 3.8 %.
TEST(TouchingEnergy, OfASpringyImpactHardlyDependsOnTheInstants) {
    const double finest = leftAfterImpact(128), fine = leftAfterImpact(64);
    EXPECT_LT(leftAfterImpact(16) - fine, 0.02);
    EXPECT_LT(leftAfterImpact(std::nullopt) - finest, 0.02);
    EXPECT_GT(leftAfterImpact(4) - leftAfterImpact(16), 0.02);
    EXPECT_LT(finest, 1.0);
}

// Where springs of one body turn far in an instant that is enough for the other, contact would feed them, 200-fold
// here.
TEST(TouchingEnergy, OfAStiffBlockOnASoftClothDoesNotRise) {
    world::SceneSpec spec = scene();
    spec.materials["linen"].dampingTime = 0.0;
    world::ClothSpec cloth = sheet("cloth", {-0.25, 0.0, -0.25}, {0.5, 0, 0}, {0, 0, 0.5}, 10);
    cloth.hold = {"edges"};
    spec.bodies.add(cloth);
    world::BlockSpec stiff = block("stiff", 0.12, {0.01, 0.08, 0.0}, 0.0);
    stiff.density = 20.0;
    stiff.young = stiff.bulk = 8e4;
    stiff.velocity = {0.0, -1.0, 0.0};
    spec.bodies.add(stiff);
    World world(spec);
    const double kinetic = world.metrics().kinetic;
    double least = world.metrics().energy();
    for (int i = 0; i < 12; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_LT(world.metrics().energy(), least + 0.02 * kinetic) << i;
        least = std::min(least, world.metrics().energy());
    }
    World resumed(spec);
    resumed.restore(world.save());
    EXPECT_FALSE(advance(world, 3));
    EXPECT_FALSE(advance(resumed, 3));
    EXPECT_EQ(resumed.stateHash(), world.stateHash());
}

// A second after they fell, and for ten more: the gain is held against what it takes to lift them by the distance that
// they keep, of which up to 5e-5 was seen, in strains that friction keeps. An instant's fall is 0.01 m/s.
TEST(TouchingEnergy, DoesNotRiseInTenSecondsAtRest) {
    for (const bool areBlocks : {false, true}) {
        world::SceneSpec spec = scene(0.5);
        spec.colliders = {ground(0.0)};
        std::vector<std::string> names;
        double mass = 0;
        for (int k = 0; k < (areBlocks ? 2 : 3); ++k) {
            const std::string name = std::to_string(k);
            if (areBlocks)
                spec.bodies.add(block(name, 0.3 - 0.1 * k, {0.0, 0.155 + 0.255 * k, 0.0}, 5e-3));
            else
                spec.bodies.add(sheet(name, {-0.1 + 0.007 * k, keep * (k + 0.5) + 0.004 * k, -0.1 + 0.005 * k},
                                      {0.2, 0, 0.01 * k}, {-0.01 * k, 0, 0.2}, 3));
            names.push_back((areBlocks ? "block." : "cloth.") + name);
            mass += areBlocks ? 300.0 * std::pow(0.3 - 0.1 * k, 3) : 0.2 * 0.2 * 0.2;
        }
        World world(spec);
        EXPECT_FALSE(advance(world, 60));
        double least = world.metrics().energy(), gain = 0;
        for (int i = 0; i < 600; ++i) {
            ASSERT_FALSE(world.advance());
            const double now = world.metrics().energy();
            least = std::min(least, now);
            gain = std::max(gain, now - least);
        }
        EXPECT_LT(gain, 1e-3 * mass * g * keep) << areBlocks;
        EXPECT_LT(fastest(world, names), 1e-3) << areBlocks;
    }
}

}  // namespace
}  // namespace taut::test::touching
