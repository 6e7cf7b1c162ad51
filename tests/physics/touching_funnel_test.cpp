// A cloth pulled through a ring that is narrower than the cloth is when it is rolled up (Harmon et al. 2008).
#include "touching_scenes.h"

namespace taut::test::touching {
namespace {

using world::World;

// Half a metre wide it has 2π 0.25 m · 8 mm = 126 cm² on its way through a hole of π 5² = 79 cm²: layers lie on each
// other in any way that there is, pressed by ring and hand. Without touch they go through each other.
TEST(TouchingFunnel, APulledClothGoesThroughARingAndNotThroughItself) {
    for (const bool touches : {true, false}) {
        world::SceneSpec spec = scene(0.2);
        spec.materials["linen"].drag = 0.5;
        spec.colliders = {ring(0.08, 0.03)};
        world::ClothSpec cloth = sheet("scarf", {-0.25, 0.04, -0.25}, {0.5, 0, 0}, {0, 0, 0.5}, 12);
        cloth.jitter = 1e-3;
        if (!touches) cloth.touch = world::Touch::nothing;
        spec.bodies.add(cloth);
        world::GrabAction grab;
        grab.t = 0.2;
        grab.target = "cloth.scarf@(0.5,0.5)";
        grab.id = "hand";
        grab.rigid = true;
        world::MoveAction pull;
        pull.t = 0.2;
        pull.id = "hand";
        pull.to = dvec3(0.0, -0.6, 0.0);
        pull.over = 1.0;
        spec.actions = {grab, pull};
        World world(spec);
        const PiercingWitness witness(spec, {"cloth.scarf"});
        int crossings = 0;
        for (int i = 0; i < 90; ++i) {
            ASSERT_FALSE(world.advance());
            crossings = std::max(crossings, witness.count(world));
        }
        EXPECT_EQ(crossings > 0, !touches) << crossings;
        for (const dvec3& x : positionsOf(world, "cloth.scarf")) EXPECT_LT(x.y, -0.03);  // below the ring
        EXPECT_EQ(world.metrics().penetration, 0);
    }
}

}  // namespace
}  // namespace taut::test::touching
