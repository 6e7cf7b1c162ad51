// Every kind of body that falls on a shape lies on it or rolls off, although all of its points may pass beside the
// shape.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::test::lying {
namespace {

struct Named {
    std::string name, text;
};

// The top of each is at y = 0.4 m, above x = X and z = 0. None is wider than 0.2 m but along z.
const Named shapes[] = {
    {"box", "shape = \"box\"\nsize = [0.2, 0.2, 1.0]\nposition = [X, 0.3, 0]\n"},
    {"sphere", "shape = \"sphere\"\nradius = 0.1\nposition = [X, 0.3, 0]\n"},
    {"capsule", "shape = \"capsule\"\nradius = 0.1\nheight = 0.8\nposition = [X, 0.3, 0]\nrotation_deg = [90, 0, 0]\n"},
    {"log", "shape = \"cylinder\"\nradius = 0.1\nheight = 1.0\nposition = [X, 0.3, 0]\nrotation_deg = [90, 0, 0]\n"},
    {"post", "shape = \"cylinder\"\nradius = 0.02\nheight = 0.2\nposition = [X, 0.3, 0]\n"},
    {"cone", "shape = \"cone\"\nradius = 0.1\nheight = 0.2\nposition = [X, 0.3, 0]\n"},
    {"two boxes",
     "shape = \"compound\"\nposition = [X, 0.3, 0]\n[[collider.under.parts]]\nshape = \"box\"\n"
     "size = [0.2, 0.2, 0.4]\nposition = [0, 0, 0.2]\n[[collider.under.parts]]\nshape = \"cylinder\"\n"
     "radius = 0.1\nheight = 0.5\nposition = [0, 0, -0.25]\nrotation_deg = [90, 0, 0]\n"},
};

// Two by three meshes; x = z = 0 is in the middle of a cord.
std::string netText() {
    std::string points, springs;
    const auto name = [](int i, int j) { return fmt::format("\"{}{}\"", i, j); };
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {
            points += fmt::format("{{ name = {}, position = [{}, 0.45, {}], mass_kg = 0.02 }}, ", name(i, j),
                                  0.4 * (i - 1), 0.23 * (j - 1.5));
            for (const auto& [m, n] : {std::pair(i + 1, j), std::pair(i, j + 1)})
                if (m < 3 && n < 4)
                    springs += fmt::format("{{ a = {}, b = {}, stiffness_N_per_m = 500.0 }}, ", name(i, j), name(m, n));
        }
    return "[net.above]\nradius = 0.005\ntouch = \"others\"\npoints = [" + points + "]\nsprings = [" + springs + "]\n";
}

// Bodies of about a metre and a crate, half a decimetre above it, with places between points over the middle.
const Named bodies[] = {
    {"plank", "[solid.above]\nshape = \"box\"\nsize = [1.0, 0.05, 0.3]\nposition = [0, 0.475, 0]\n"},
    {"crate", "[solid.above]\nshape = \"box\"\nsize = [0.15, 0.15, 0.15]\nposition = [0, 0.525, 0]\n"},
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
    {"net", netText()},
};

struct Fall {
    double top, deepest;  // [m] highest point at the end; into the shape at most
};
// After 0.3 s, with the shape at x.
Fall fall(const Named& body, const Named& shape, const std::string& x, const std::string& what) {
    const std::size_t end = body.text.find(".above]"), start = body.text.rfind('[', end) + 1;
    const std::string target = body.text.substr(start, end - start) + ".above";
    std::string under = shape.text;
    under.replace(under.find('X'), 1, x);
    const std::string text = "schema = 1\n" + body.text + "[collider.under]\n" + under;
    world::World world(scene::loadSceneText(text, what, {}).spec);
    Fall fall{-1e300, 0.0};
    while (world.time() < 0.3) {
        EXPECT_FALSE(world.advance()) << what;
        const world::Metrics now = world.metrics();
        fall.deepest = std::max({fall.deepest, now.penetration, now.facePenetration});
    }
    for (const glm::dvec3& place : world.points(target).x) fall.top = std::max(fall.top, place.y);
    return fall;
}

TEST(Lying, EveryBodyLiesOnEveryShape) {
    for (const Named& shape : shapes)
        for (const Named& body : bodies) {
            const std::string what = body.name + " on " + shape.name;
            const Fall found = fall(body, shape, "0", what);
            EXPECT_GT(found.top, 0.399) << what;  // free fall in this time is 0.44 m
            EXPECT_LT(found.deepest, 1e-3) << what;
        }
}

// The middle of a body is beyond the side of the shape: it tips or slides down there.
TEST(Lying, NoBodySinksIntoAShapeThatItRollsOff) {
    for (const Named& shape : shapes)
        for (const Named& body : bodies) {
            const std::string what = body.name + " off " + shape.name;
            EXPECT_LT(fall(body, shape, "-0.13", what).deepest, 1e-3) << what;
        }
}

}  // namespace
}  // namespace taut::test::lying
