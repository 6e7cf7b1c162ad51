#include <gtest/gtest.h>

#include <cmath>

#include "mechanics_lattice_facts.h"
#include "taut/core/error.h"
#include "taut/mechanics/builders.h"

namespace taut::mechanics {
namespace {

using namespace test;

constexpr double meshRounding = 1e-11;  // sums over some hundred springs

// Rows of equilateral triangles with side c, a parallelogram of cells by cells.
MeshClothShape equilateral(int cells, double c) {
    MeshClothShape shape;
    shape.material.bend = 0.0;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) shape.positions.emplace_back(c * (i + 0.5 * j), 0.0, -c * j * std::sqrt(0.75));
    const int row = cells + 1;
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const int p = j * row + i;
            shape.triangles.push_back({p, p + 1, p + row});
            shape.triangles.push_back({p + 1, p + row + 1, p + row});
        }
    return shape;
}

std::string messageFor(const MeshClothShape& shape) {
    try {
        buildMeshCloth(shape);
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        return error.what();
    }
    return "";
}

// Van Gelder is exact on this lattice: C11 = E₂D/(1 - ν²), C12 = ν C11, ν = 1/3, with E₂D = 4/3 stretch.
TEST(MeshClothBuilder, EquilateralLatticeIsExact) {
    for (int cells : {2, 5, 10}) {
        MeshClothShape shape = equilateral(cells, 1.0 / cells);
        shape.material.stretch = 900.0;
        const Model model = buildMeshCloth(shape);
        EXPECT_EQ(brokenRule(model), "");
        const double young = 1200.0, area = std::sqrt(0.75);
        EXPECT_NEAR(normalStiffness(model, 0, 0, area), young * 9.0 / 8.0, young * meshRounding);
        EXPECT_NEAR(normalStiffness(model, 2, 2, area), young * 9.0 / 8.0, young * meshRounding);
        EXPECT_NEAR(normalStiffness(model, 0, 2, area), young * 3.0 / 8.0, young * meshRounding);
        EXPECT_NEAR(shearStiffness(model, 0, 2, area), young * 3.0 / 8.0, young * meshRounding);
    }
}

// An isotropic grid cloth and a mesh of the same material answer alike: C11 = ks + kd = 3/2 ks = 9/8 E₂D.
TEST(MeshClothBuilder, AgreesWithTheGridOnAnIsotropicMaterial) {
    ClothShape grid;
    grid.material.stretch = 900.0;
    grid.material.shear = 450.0;
    grid.material.bend = 0.0;
    MeshClothShape mesh = equilateral(4, 0.25);
    mesh.material.stretch = 900.0;
    EXPECT_NEAR(normalStiffness(buildMeshCloth(mesh), 0, 0, std::sqrt(0.75)),
                normalStiffness(buildCloth(grid), 0, 0, 1.0), 1350.0 * meshRounding);
}

TEST(MeshClothBuilder, MassIsDensityTimesArea) {
    for (Lumping lumping : {Lumping::weighted, Lumping::uniform}) {
        MeshClothShape shape = equilateral(3, 0.4);
        shape.material.lumping = lumping;
        EXPECT_NEAR(totalMass(buildMeshCloth(shape)), 0.2 * 1.2 * 1.2 * std::sqrt(0.75), meshRounding);
    }
}

TEST(MeshClothBuilder, BendSpringsCrossInnerEdges) {
    MeshClothShape shape = equilateral(2, 0.5);
    shape.material.bend = 3.0;
    const Model model = buildMeshCloth(shape);
    int edges = 0, crossing = 0;
    for (const Spring& s : model.springs) {
        if (s.kind != SpringKind::bend) {
            ++edges;
            continue;
        }
        ++crossing;
        EXPECT_NEAR(s.restLength, 2.0 * 0.5 * std::sqrt(0.75), meshRounding);
        EXPECT_EQ(s.stiffness, 3.0);
    }
    EXPECT_EQ(edges, 16);
    EXPECT_EQ(crossing, 8);
}

// Every corner of a tetrahedron's surface is joined to every other: there is nothing to cross.
TEST(MeshClothBuilder, ClosedSurfaceHasNoBoundaryAndNoDoubleSprings) {
    MeshClothShape shape;
    shape.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    shape.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    const Model model = buildMeshCloth(shape);
    EXPECT_EQ(model.springs.size(), 6U);
    EXPECT_TRUE(model.groups.at("boundary").empty());
}

TEST(MeshClothBuilder, GroupsAreWhereTheirNamesSay) {
    MeshClothShape shape;
    shape.positions = {{0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 0.5, 0}};
    shape.triangles = {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0}};
    const Model model = buildMeshCloth(shape);
    EXPECT_EQ(model.groups.at("boundary"), (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(model.groups.at("top"), (std::vector<int>{0, 3}));
    EXPECT_EQ(model.groups.at("bottom"), (std::vector<int>{1, 2}));
    EXPECT_EQ(model.groups.at("left"), (std::vector<int>{0, 1}));
    EXPECT_EQ(model.groups.at("right"), (std::vector<int>{2, 3}));
    EXPECT_EQ(model.groups.at("top-left"), std::vector<int>{0});
    EXPECT_EQ(model.groups.at("bottom-left"), std::vector<int>{1});
    EXPECT_EQ(model.groups.at("bottom-right"), std::vector<int>{2});
    EXPECT_EQ(model.groups.at("top-right"), std::vector<int>{3});
}

TEST(MeshClothBuilder, MakesUvFromTheTwoLongestAxes) {
    const MeshClothShape shape = equilateral(2, 0.5);
    const Model model = buildMeshCloth(shape);
    for (int i = 0; i < model.pointCount(); ++i) {
        const glm::dvec2 uv = model.uv[i];
        EXPECT_EQ(uv.x, at(model.positions, i).x);
        EXPECT_NEAR(uv.y, at(model.positions, i).z + std::sqrt(0.75), meshRounding);
    }
    MeshClothShape given = shape;
    given.uv.assign(given.positions.size(), {0.25, 0.5});
    EXPECT_EQ(buildMeshCloth(given).uv[3], glm::dvec2(0.25, 0.5));
}

TEST(MeshClothBuilder, NamesWhatIsWrong) {
    MeshClothShape shape = equilateral(1, 1.0);
    EXPECT_EQ(messageFor(shape), "");

    MeshClothShape empty = shape;
    empty.triangles.clear();
    EXPECT_EQ(messageFor(empty), "there are no faces");

    MeshClothShape fan = shape;
    fan.positions.emplace_back(0.5, 1.0, 0.0);
    fan.triangles.push_back({1, 2, 4});
    EXPECT_EQ(
        messageFor(fan),
        "this face is the third at the edge between vertices 2 and 3, which takes two: delete faces that lie double or "
        "inside");

    MeshClothShape turned = shape;
    std::swap(turned.triangles[1][0], turned.triangles[1][1]);
    EXPECT_EQ(messageFor(turned),
              "this face and the other at the edge between vertices 2 and 3 face opposite ways: recalculate normals");

    MeshClothShape flat = shape;
    flat.positions[3] = 0.5 * (flat.positions[1] + flat.positions[2]);
    EXPECT_EQ(messageFor(flat), "vertices 2, 4 and 3 of this face lie on a line: merge by distance, or triangulate it");

    MeshClothShape beyond = shape;
    beyond.triangles[0][1] = 9;
    EXPECT_EQ(messageFor(beyond), "there is no vertex 10 of 4");

    MeshClothShape spare = shape;
    spare.positions.emplace_back(5.0, 5.0, 5.0);
    EXPECT_EQ(messageFor(spare), "vertex 5 belongs to no face");

    MeshClothShape infinite = shape;
    infinite.positions[2].y = std::nan("");
    EXPECT_EQ(messageFor(infinite), "vertex 3 is not finite");

    MeshClothShape partly = shape;
    partly.uv.resize(2);
    EXPECT_EQ(messageFor(partly), "some of the vertices only have texture coordinates");
}

}  // namespace
}  // namespace taut::mechanics
