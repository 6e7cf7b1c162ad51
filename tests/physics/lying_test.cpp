// Every kind of body that falls on a shape lies on it, although all of its points may pass beside the shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::test::lying {
namespace {

struct Named {
    std::string name, text;
};

// The top of each is at y = 0.4 m, above x = z = 0. None is wider than 0.2 m but along z.
const Named shapes[] = {
    {"box", "shape = \"box\"\nsize = [0.2, 0.2, 1.0]\nposition = [0, 0.3, 0]\n"},
    {"sphere", "shape = \"sphere\"\nradius = 0.1\nposition = [0, 0.3, 0]\n"},
    {"capsule", "shape = \"capsule\"\nradius = 0.1\nheight = 0.8\nposition = [0, 0.3, 0]\nrotation_deg = [90, 0, 0]\n"},
    {"log", "shape = \"cylinder\"\nradius = 0.1\nheight = 1.0\nposition = [0, 0.3, 0]\nrotation_deg = [90, 0, 0]\n"},
    {"post", "shape = \"cylinder\"\nradius = 0.02\nheight = 0.2\nposition = [0, 0.3, 0]\n"},
    {"cone", "shape = \"cone\"\nradius = 0.1\nheight = 0.2\nposition = [0, 0.3, 0]\n"},
    {"two boxes",
     "shape = \"compound\"\nposition = [0, 0.3, 0]\n[[collider.under.parts]]\nshape = \"box\"\n"
     "size = [0.2, 0.2, 0.4]\nposition = [0, 0, 0.2]\n[[collider.under.parts]]\nshape = \"cylinder\"\n"
     "radius = 0.1\nheight = 0.5\nposition = [0, 0, -0.25]\nrotation_deg = [90, 0, 0]\n"},
};

// Bodies of about a metre, half a decimetre above it, with places between points over the middle.
const Named bodies[] = {
    {"plank", "[solid.above]\nshape = \"box\"\nsize = [1.0, 0.05, 0.3]\nposition = [0, 0.475, 0]\n"},
    {"bar",
     "[solid.above]\nshape = \"cylinder\"\nradius = 0.01\nheight = 1.0\nposition = [0, 0.46, 0]\n"
     "rotation_deg = [0, 0, 90]\n"},
    {"cloth",
     "[material.m]\n[cloth.above]\nmaterial = \"m\"\nsize = [1.3, 0.9]\ncells = [3, 3]\ndown = [0, 0, 1]\n"
     "origin = [-0.65, 0.45, -0.45]\ntouch = \"others\"\n"},
    {"rope", "[rope.above]\nends = [[-0.6, 0.45, 0], [0.6, 0.45, 0]]\nsegments = 5\ntouch = \"others\"\n"},
    {"block",
     "[block.above]\nposition = [0, 0.5, 0]\nsize = [0.9, 0.08, 0.3]\ncells = [3, 1, 1]\n"
     "young_Pa = 2e5\ntouch = \"others\"\n"},
};

TEST(Lying, EveryBodyLiesOnEveryShape) {
    for (const Named& shape : shapes)
        for (const Named& body : bodies) {
            const std::string what = body.name + " on " + shape.name;
            const std::size_t end = body.text.find(".above]"), start = body.text.rfind('[', end) + 1;
            const std::string target = body.text.substr(start, end - start) + ".above";
            const std::string text = "schema = 1\n" + body.text + "[collider.under]\n" + shape.text;
            world::World world(scene::loadSceneText(text, what, {}).spec);
            double deepest = 0;
            while (world.time() < 0.3) {
                ASSERT_FALSE(world.advance()) << what;
                const world::Metrics now = world.metrics();
                deepest = std::max({deepest, now.penetration, now.facePenetration});
            }
            double top = -1e300;
            for (const glm::dvec3& x : world.points(target).x) top = std::max(top, x.y);
            EXPECT_GT(top, 0.399) << what;  // free fall in this time is 0.44 m
            EXPECT_LT(deepest, 1e-3) << what;
        }
}

}  // namespace
}  // namespace taut::test::lying
