#include "taut/view/private/tube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "view_mesh_facts.h"

namespace taut::view::test {
namespace {

std::vector<glm::vec3> helix(int points) {
    std::vector<glm::vec3> line;
    for (int i = 0; i < points; ++i) {
        const float angle = 0.3F * static_cast<float>(i);
        line.emplace_back(std::cos(angle), 0.1F * angle, std::sin(angle));
    }
    return line;
}

TEST(ViewTube, GeometryFitsTheTopology) {
    for (const int sides : {3, 8, 13}) {
        const Topology topology = tubeTopology(7, 3, sides, 2.0F, 0.05F);
        const Geometry geometry = tubeGeometry(helix(7), 3, sides, 0.05F);
        EXPECT_EQ(geometry.positions.size(), topology.uv.size());
        EXPECT_EQ(geometry.normals.size(), topology.uv.size());
        for (const std::uint32_t corner : topology.triangles) ASSERT_LT(corner, geometry.positions.size());
    }
}

TEST(ViewTube, IsClosedAndFacesOutwards) {
    const Topology topology = tubeTopology(30, 2, 12, 9.0F, 0.05F);
    const Geometry geometry = tubeGeometry(helix(30), 2, 12, 0.05F);
    EXPECT_EQ(openEdges(topology, geometry), 0);
    EXPECT_LT(normalLengthError(geometry), 1e-6F);  // a few roundings of a normalised float vector
    // Facets of twelve sides lean by 15 degrees (cosine 0.966), those of the three-ring caps by as much again.
    EXPECT_GT(leastAgreement(topology, geometry), 0.85F);
}

TEST(ViewTube, StraightTubeHasTheVolumeOfItsPrism) {
    const std::vector<glm::vec3> line{{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}};
    const float r = 0.01F;
    const int sides = 16;
    const float prism = 0.5F * static_cast<float>(sides) * r * r *
                        std::sin(2.0F * std::numbers::pi_v<float> / static_cast<float>(sides)) * 2.0F;
    const float caps = 4.0F / 3.0F * std::numbers::pi_v<float> * r * r * r;
    const float measured = volume(tubeTopology(3, 4, sides, 2.0F, r), tubeGeometry(line, 4, sides, r));
    EXPECT_GT(measured, prism);
    EXPECT_LT(measured, prism + caps);
}

TEST(ViewTube, PassesThroughItsPoints) {
    const std::vector<glm::vec3> line = helix(6);
    const int sides = 8;
    const int subdivisions = 3;
    const Geometry geometry = tubeGeometry(line, subdivisions, sides, 0.05F);
    // Every ring's centre is the mean of its corners; a cap of eight sides has one ring, after one pole.
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::size_t ring = 1 + i * static_cast<std::size_t>(subdivisions);
        glm::vec3 mean(0.0F);
        for (std::size_t k = 0; k < 8; ++k) mean += geometry.positions[1 + ring * 8 + k] / 8.0F;
        EXPECT_LT(glm::distance(mean, line[i]), 1e-6F);  // rounding of coordinates of the order of 1
    }
}

TEST(ViewTube, FrameDoesNotTwistInAPlane) {
    // Along a plane curve the corner that points out of the plane keeps doing so.
    std::vector<glm::vec3> line;
    for (int i = 0; i < 20; ++i)
        line.emplace_back(std::sin(0.4F * static_cast<float>(i)), 0.0F, 0.2F * static_cast<float>(i));
    const Geometry geometry = tubeGeometry(line, 4, 8, 0.05F);
    const std::size_t rings = (geometry.positions.size() - 2) / 8;
    std::size_t upwards = 0;
    for (std::size_t k = 0; k < 8; ++k)
        if (std::abs(geometry.normals[1 + 8 + k].y) > 0.99F) upwards = k;
    for (std::size_t ring = 1; ring + 1 < rings; ++ring)
        EXPECT_GT(std::abs(geometry.normals[1 + ring * 8 + upwards].y), 0.999F);  // rounding only; a twist of 3° fails
}

TEST(ViewTube, MaterialCoordinatesMeasureTheRope) {
    const int sides = 8;
    const Topology topology = tubeTopology(5, 2, sides, 4.0F, 0.1F);
    const std::size_t firstRing = 1 + 8;  // after the pole and the cap's ring
    EXPECT_FLOAT_EQ(topology.uv[firstRing].x, 0.0F);
    EXPECT_FLOAT_EQ(topology.uv[firstRing + 8 * 8].x, 4.0F);
    EXPECT_FLOAT_EQ(topology.uv[firstRing + 4].y, 0.1F * std::numbers::pi_v<float>);  // half way round
}

TEST(ViewTube, CoincidentPointsStayFinite) {
    const std::vector<glm::vec3> same(4, glm::vec3(1.0F, 2.0F, 3.0F));
    const std::vector<glm::vec3> pairs{
        {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}};
    for (const auto& line : {same, pairs}) {
        const Geometry geometry = tubeGeometry(line, 3, 6, 0.1F);
        for (const glm::vec3& p : geometry.positions)
            EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        EXPECT_LT(normalLengthError(geometry), 1e-6F);
    }
}

}  // namespace
}  // namespace taut::view::test
