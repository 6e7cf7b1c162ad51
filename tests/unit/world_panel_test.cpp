// Cloth with an outline: its place, and the names of its edges.
#include <gtest/gtest.h>

#include "taut/bodies/cloth.h"
#include "taut/core/error.h"
#include "taut/core/trig.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

// A trapezium; its edge "left" lies on the right.
ClothSpec panel() {
    ClothSpec cloth;
    cloth.corners = {{-0.2, 0.5}, {-0.4, 0}, {0.4, 0}, {0.2, 0.5}};
    cloth.edges = {{"left", {2, 3}}, {"round", {2, 1}}};
    cloth.cell = 0.1;
    return cloth;
}

std::vector<dvec3> placesOf(const mechanics::Model& model, const char* selector) {
    std::vector<dvec3> places;
    for (const int i : selectPoints(model, selector)) places.push_back(model.positions[i]);
    return places;
}

TEST(Panels, HaveEdgesInTheOrderOfTheirCorners) {
    const mechanics::Model model = panel().build({});
    const std::vector<dvec3> top = placesOf(model, "side3");
    ASSERT_EQ(top.size(), 5U);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(glm::distance(top[i], dvec3(0.2 - 0.1 * i, 0.5, 0)), 0, 1e-15);
    EXPECT_EQ(placesOf(model, "left"), placesOf(model, "side2"));
    // Over the first corner, and all the way round but for a side.
    const std::vector<dvec3> round = placesOf(model, "round");
    EXPECT_EQ(round.size(),
              placesOf(model, "side2").size() + placesOf(model, "side3").size() + placesOf(model, "side0").size() - 2);
    EXPECT_EQ(round.front(), dvec3(0.4, 0, 0));
    EXPECT_EQ(round.back(), dvec3(-0.4, 0, 0));
    // Points without a named edge are the ones furthest out, as of all meshes.
    EXPECT_EQ(placesOf(model, "bottom").size(), 9U);
}

TEST(Panels, LieAcrossAndDownFromTheirOriginWithTheFrontThatGridsHave) {
    ClothSpec cloth = panel(), grid;
    cloth.origin = {1, 2, 3};
    cloth.across = grid.across = {0, 0, 2};
    cloth.down = grid.down = {3, 0, 0};
    const mechanics::Model model = cloth.build({}), like = grid.build({});
    EXPECT_EQ(placesOf(model, "side0").back(), dvec3(1, 2, 2.6));  // y against down
    EXPECT_EQ(placesOf(model, "side2").back(), dvec3(0.5, 2, 3.2));
    const auto front = [](const mechanics::Model& of) {
        const auto& [a, b, c] = of.triangles.front();
        const auto at = [&](int i) { return of.positions[i]; };
        return glm::normalize(glm::cross(at(b) - at(a), at(c) - at(a)));
    };
    EXPECT_NEAR(glm::dot(front(model), front(like)), 1, 1e-12);
}

// As of a grid, the grain turns the warp from across towards down.
TEST(Panels, HaveTheirWarpAlongTheGrain) {
    SceneSpec scene;
    MaterialSpec& material = scene.materials["twill"];
    material.rigidity = {.warp = 2e-5, .weft = 1e-5, .bias = {}};
    ClothSpec cloth = panel();
    cloth.material = "twill";
    cloth.grain = core::radians(30.0);
    for (const dvec3& warp : cloth.build(scene).freeform.warp)
        EXPECT_NEAR(glm::distance(warp, dvec3(core::cosine(cloth.grain), -core::sine(cloth.grain), 0)), 0, 1e-12);
}

TEST(Panels, AreRefusedWhereTheyAreBuiltWithoutALoader) {
    ClothSpec cloth = panel();
    std::swap(cloth.corners[0], cloth.corners[1]);
    EXPECT_THROW(cloth.build({}), core::Error);
}

}  // namespace
}  // namespace taut::world
