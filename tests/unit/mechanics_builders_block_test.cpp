#include <gtest/gtest.h>

#include <map>

#include "mechanics_lattice_facts.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/cell_shape.h"

namespace taut::mechanics {
namespace {

using namespace test;

// Sums over some thousand springs.
constexpr double blockRounding = 1e-11;

BlockShape cubes(int n) {
    BlockShape shape;
    shape.centre = {0.5, 1.0, -2.0};
    shape.size = {0.9, 0.6, 0.3};
    shape.cells = {3 * n, 2 * n, n};
    shape.bulk = 2e4;
    return shape;
}

TEST(BlockBuilder, MassAndCentreAreTheMaterials) {
    for (Lumping lumping : {Lumping::weighted, Lumping::uniform})
        for (int n : {1, 3}) {
            BlockShape shape = cubes(n);
            shape.lumping = lumping;
            const Model model = buildBlock(shape);
            EXPECT_EQ(brokenRule(model), "");
            EXPECT_NEAR(totalMass(model), 300.0 * 0.9 * 0.6 * 0.3, 50.0 * blockRounding);
            EXPECT_NEAR(glm::length(centreOfMass(model) - shape.centre), 0.0, blockRounding);
        }
}

// A box has M (a² + b²)/12 about each axis, from two cells on; masses in the corners of one have three times as much.
TEST(BlockBuilder, InertiaIsTheBoxsFromTwoCellsOn) {
    for (const glm::ivec3& cells : {glm::ivec3(2, 2, 2), glm::ivec3(5, 2, 3), glm::ivec3(1, 1, 1)}) {
        BlockShape shape = cubes(1);
        shape.cells = cells;
        const Model model = buildBlock(shape);
        const glm::dvec3 square = meanSquares(model);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(square[axis], shape.size[axis] * shape.size[axis] * (cells[axis] == 1 ? 1.0 / 4 : 1.0 / 12),
                        1e-12);
    }
}

// k = 0.4 E ℓ on edges and face diagonals: C11 = 1.2 E, C12 = C44 = 0.4 E, which is E with ν = 1/4.
TEST(BlockBuilder, CubicCellsHaveTheMaterialsStiffnessAtEveryResolution) {
    for (int n : {1, 2, 3}) {
        BlockShape shape = cubes(n);
        shape.young = 5e4;
        const Model model = buildBlock(shape);
        const double volume = 0.9 * 0.6 * 0.3;
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(normalStiffness(model, i, i, volume), 6e4, 6e4 * blockRounding);
            EXPECT_NEAR(normalStiffness(model, i, (i + 1) % 3, volume), 2e4, 6e4 * blockRounding);
            EXPECT_NEAR(shearStiffness(model, i, (i + 1) % 3, volume), 2e4, 6e4 * blockRounding);
        }
    }
}

TEST(BlockBuilder, NearlyCubicCellsHaveTheSameStiffness) {
    BlockShape shape = cubes(1);
    shape.young = 5e4;
    shape.size = {0.9, 0.66, 0.28};
    const Model model = buildBlock(shape);
    const double volume = 0.9 * 0.66 * 0.28;
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(normalStiffness(model, i, i, volume), 6e4, 6e4 * blockRounding);
        EXPECT_NEAR(normalStiffness(model, i, (i + 1) % 3, volume), 2e4, 6e4 * blockRounding);
        EXPECT_NEAR(shearStiffness(model, i, (i + 1) % 3, volume), 2e4, 6e4 * blockRounding);
    }
}

TEST(BlockBuilder, LongCellsKeepShearAndNeverHaveANegativeSpring) {
    BlockShape shape = cubes(1);
    shape.young = 5e4;
    shape.size = {1.8, 0.6, 0.3};
    const Model model = buildBlock(shape);
    const double volume = 1.8 * 0.6 * 0.3;
    EXPECT_EQ(brokenRule(model), "");
    EXPECT_NEAR(shearStiffness(model, 0, 1, volume), 2e4, 6e4 * blockRounding);
    // Stretched cells are stiffer along their long side: 0.4 E (0.1 + 4 + 4).
    EXPECT_NEAR(normalStiffness(model, 0, 0, volume), 0.4 * 5e4 * 8.1, 2e5 * blockRounding);
    EXPECT_NEAR(normalStiffness(model, 1, 1, volume), 6e4, 2e5 * blockRounding);
}

// Shares of edges and faces: inside all is in balance, a face point bears the stress times its share of the face.
TEST(BlockBuilder, UniformStrainLoadsOnlyTheSurfaceAndEachPointByItsShare) {
    BlockShape shape = cubes(2);
    shape.young = 5e4;
    const Model model = buildBlock(shape);
    glm::dmat3 strain(0.0);
    strain[0][0] = 0.01;
    const double l = 0.15;
    const glm::dvec3 stress(6e4 * 0.01, 2e4 * 0.01, 2e4 * 0.01);
    const std::vector<glm::dvec3> forces = strainForces(model, strain);
    const glm::ivec3 n = shape.cells;
    int i = 0;
    for (int z = 0; z <= n.z; ++z)
        for (int y = 0; y <= n.y; ++y)
            for (int x = 0; x <= n.x; ++x, ++i) {
                const glm::ivec3 p(x, y, z);
                for (int axis = 0; axis < 3; ++axis) {
                    double share = l * l;
                    for (int other : {(axis + 1) % 3, (axis + 2) % 3})
                        if (p[other] == 0 || p[other] == n[other]) share *= 0.5;
                    const double side = p[axis] == 0 ? 1.0 : p[axis] == n[axis] ? -1.0 : 0.0;
                    EXPECT_NEAR(at(forces, i)[axis], side * share * stress[axis], 100.0 * blockRounding);
                }
            }
}

TEST(BlockBuilder, SpringsOfAKindShareOneRestLength) {
    const Model model = buildBlock(cubes(2));
    std::map<double, int> lengths;
    for (const Spring& s : model.springs) ++lengths[s.restLength];
    // Three kinds of edges and of diagonals; a cube's may agree to the last bit or not.
    EXPECT_LE(lengths.size(), 6U);
}

TEST(BlockBuilder, CellsAndTheirTetrahedraAreRightHandedAndFillTheBlock) {
    BlockShape shape = cubes(2);
    shape.axes = glm::dmat3(0.6, 0.8, 0.0, -0.8, 0.6, 0.0, 0.0, 0.0, 1.0);
    const Model model = buildBlock(shape);
    EXPECT_EQ(model.cells.size(), 6U * 4U * 2U);
    double volume = 0.0;
    for (const VolumeCell& cell : model.cells) {
        // 3.4e-3 m³ from coordinates of about 2.
        EXPECT_NEAR(volumeOf(cornersOf(cell, model.positions)), cell.restVolume, 1e-15);
        for (std::size_t t = 0; t < cellTetrahedra.size(); ++t) {
            const auto [a, b, c, d] = tetrahedronOf(cell, t);
            const glm::dvec3 p = at(model.positions, a);
            EXPECT_NEAR(glm::dot(at(model.positions, b) - p,
                                 glm::cross(at(model.positions, c) - p, at(model.positions, d) - p)),
                        cell.restVolume, 1e-15);  // each a sixth of the cell
        }
        volume += cell.restVolume;
    }
    EXPECT_NEAR(volume, 0.9 * 0.6 * 0.3, blockRounding);
}

TEST(BlockBuilder, SurfaceIsClosedAndFacesOutward) {
    const BlockShape shape = cubes(2);
    const Model model = buildBlock(shape);
    std::map<std::pair<int, int>, int> edges;
    double volume = 0.0;
    for (const auto& [a, b, c] : model.triangles) {
        ++edges[{a, b}];
        ++edges[{b, c}];
        ++edges[{c, a}];
        // The divergence theorem; each triangle lies on a face of a convex body, so every term is positive.
        const double part =
            glm::dot(at(model.positions, a) - shape.centre,
                     glm::cross(at(model.positions, b) - shape.centre, at(model.positions, c) - shape.centre)) /
            6.0;
        EXPECT_GT(part, 0.0);
        volume += part;
    }
    EXPECT_NEAR(volume, 0.9 * 0.6 * 0.3, blockRounding);
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
}

TEST(BlockBuilder, GroupsAreWhereTheirNamesSay) {
    const BlockShape shape = cubes(1);
    const Model model = buildBlock(shape);
    const std::pair<const char*, glm::dvec3> sides[] = {{"left", {-1, 0, 0}},   {"right", {1, 0, 0}},
                                                        {"bottom", {0, -1, 0}}, {"top", {0, 1, 0}},
                                                        {"back", {0, 0, -1}},   {"front", {0, 0, 1}}};
    for (const auto& [name, normal] : sides) {
        const double reach = 0.5 * glm::dot(shape.size, glm::abs(normal));
        std::vector<int> expected;
        for (int i = 0; i < model.pointCount(); ++i)
            if (glm::dot(at(model.positions, i) - shape.centre, normal) > reach - 1e-9) expected.push_back(i);
        EXPECT_EQ(model.groups.at(name), expected) << name;
    }
    EXPECT_EQ(model.groups.at("corners").size(), 8U);
}

TEST(BlockBuilder, WithoutBulkHasNoCells) {
    BlockShape shape = cubes(1);
    shape.bulk = 0.0;
    EXPECT_TRUE(buildBlock(shape).cells.empty());
}

}  // namespace
}  // namespace taut::mechanics
