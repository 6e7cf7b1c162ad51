#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mechanics_lattice_facts.h"
#include "taut/mechanics/builders.h"

namespace taut::mechanics {
namespace {

using namespace test;

// Sums over some thousand springs: relative errors of about √n · 1e-16, at most n · 1e-16.
constexpr double clothRounding = 1e-11;

ClothShape flag(int across, int down) {
    ClothShape shape;
    shape.origin = {0.3, 3.0, -1.0};
    shape.size = {1.8, 1.2};
    shape.cells = {across, down};
    shape.material.bend = 0.0;
    return shape;
}

TEST(ClothBuilder, MassAndCentreAreTheMaterials) {
    for (Lumping lumping : {Lumping::weighted, Lumping::uniform})
        for (int cells : {1, 4, 33}) {
            ClothShape shape = flag(cells, cells + 1);
            shape.material.lumping = lumping;
            const Model model = buildCloth(shape);
            EXPECT_EQ(brokenRule(model), "");
            EXPECT_NEAR(totalMass(model), 0.2 * 1.8 * 1.2, clothRounding);
            EXPECT_NEAR(glm::length(centreOfMass(model) - glm::dvec3(1.2, 2.4, -1.0)), 0.0, clothRounding);
        }
}

TEST(ClothBuilder, WeightedMassesAreAQuarterAndAHalfOnTheBoundary) {
    const Model model = buildCloth(flag(6, 4));
    const double cell = 0.2 * 0.3 * 0.3;
    EXPECT_NEAR(model.masses[0], cell / 4, clothRounding);
    EXPECT_NEAR(model.masses[3], cell / 2, clothRounding);
    EXPECT_NEAR(model.masses[7], cell / 2, clothRounding);
    EXPECT_NEAR(model.masses[8], cell, clothRounding);
}

// C11 = C22 = ks + kd, C12 = C66 = kd, at any resolution.
TEST(ClothBuilder, SquareCellsHaveTheMaterialsStiffnessAtEveryResolution) {
    for (int fineness : {1, 2, 4}) {
        ClothShape shape = flag(6 * fineness, 4 * fineness);
        shape.material.stretch = 900.0;
        shape.material.shear = 400.0;
        const Model model = buildCloth(shape);
        const double area = 1.8 * 1.2;
        EXPECT_NEAR(normalStiffness(model, 0, 0, area), 1300.0, 1300.0 * clothRounding);
        EXPECT_NEAR(normalStiffness(model, 1, 1, area), 1300.0, 1300.0 * clothRounding);
        EXPECT_NEAR(normalStiffness(model, 0, 1, area), 400.0, 1300.0 * clothRounding);
        EXPECT_NEAR(shearStiffness(model, 0, 1, area), 400.0, 1300.0 * clothRounding);
    }
}

TEST(ClothBuilder, HalfShearIsIsotropic) {
    ClothShape shape = flag(6, 4);
    shape.material.shear = shape.material.stretch / 2.0;
    const Model model = buildCloth(shape);
    const double c11 = normalStiffness(model, 0, 0, 1.0), c12 = normalStiffness(model, 0, 1, 1.0);
    EXPECT_NEAR(shearStiffness(model, 0, 1, 1.0), (c11 - c12) / 2.0, c11 * clothRounding);
    EXPECT_NEAR(c12 / c11, 1.0 / 3.0, clothRounding);
}

// A cell a by b: C12 = C66 = kd, C11 = ks + kd a²/b².
TEST(ClothBuilder, LongCellsKeepStretchAndShearPerMetre) {
    for (int fineness : {1, 3}) {
        ClothShape shape = flag(6 * fineness, 8 * fineness);
        shape.material.stretch = 900.0;
        shape.material.shear = 400.0;
        const Model model = buildCloth(shape);
        const double area = 1.8 * 1.2, aspect = (1.8 / 6) / (1.2 / 8);
        EXPECT_NEAR(normalStiffness(model, 0, 1, area), 400.0, 2500.0 * clothRounding);
        EXPECT_NEAR(shearStiffness(model, 0, 1, area), 400.0, 2500.0 * clothRounding);
        EXPECT_NEAR(normalStiffness(model, 0, 0, area), 900.0 + 400.0 * aspect * aspect, 2500.0 * clothRounding);
        EXPECT_NEAR(normalStiffness(model, 1, 1, area), 900.0 + 400.0 / (aspect * aspect), 2500.0 * clothRounding);
    }
}

// Under a uniform strain the cloth is in balance inside, and each boundary point bears the stress times its share
// of the boundary: the reason for halved springs.
TEST(ClothBuilder, UniformStrainLoadsOnlyTheBoundaryAndEachPointByItsShare) {
    ClothShape shape = flag(6, 4);
    shape.material.stretch = 900.0;
    shape.material.shear = 400.0;
    const Model model = buildCloth(shape);
    glm::dmat3 strain(0.0);
    strain[0][0] = 0.01;
    const double side = 0.3, alongX = 1300.0 * 0.01, alongY = 400.0 * 0.01;
    const std::vector<glm::dvec3> forces = strainForces(model, strain);
    for (int j = 0; j <= 4; ++j)
        for (int i = 0; i <= 6; ++i) {
            const double shareX = side * (j == 0 || j == 4 ? 0.5 : 1.0);
            const double shareY = side * (i == 0 || i == 6 ? 0.5 : 1.0);
            const double fx = i == 0 ? alongX * shareX : i == 6 ? -alongX * shareX : 0.0;
            const double fy = j == 0 ? -alongY * shareY : j == 4 ? alongY * shareY : 0.0;
            const glm::dvec3 force = at(forces, j * 7 + i);
            EXPECT_NEAR(force.x, fx, clothRounding) << i << ' ' << j;
            EXPECT_NEAR(force.y, fy, clothRounding) << i << ' ' << j;
            EXPECT_EQ(force.z, 0.0);
        }
}

// Away from the ends span-2 springs add 4 kb; over the whole cloth n - 1 of n cells' worth of them.
TEST(ClothBuilder, BendSpringsStiffenInPlaneByFourKb) {
    ClothShape shape = flag(18, 12);
    shape.material.shear = 0.0;
    const double without = normalStiffness(buildCloth(shape), 0, 0, 1.8 * 1.2);
    shape.material.bend = 10.0;
    const double with = normalStiffness(buildCloth(shape), 0, 0, 1.8 * 1.2);
    EXPECT_NEAR(with - without, 4.0 * 10.0 * 17.0 / 18.0, 1000.0 * clothRounding);
}

TEST(ClothBuilder, SpringsComeByKindAndShareRestLengths) {
    ClothShape shape = flag(6, 5);
    shape.material.bend = 1.0;
    const Model model = buildCloth(shape);
    const std::size_t expected = 6U * 6U + 7U * 5U + 2U * 30U + 5U * 6U + 7U * 4U;
    EXPECT_EQ(model.springs.size(), expected);
    std::set<double> lengths;
    for (std::size_t i = 0; i < model.springs.size(); ++i) {
        lengths.insert(model.springs[i].restLength);
        if (i > 0) EXPECT_LE(static_cast<int>(model.springs[i - 1].kind), static_cast<int>(model.springs[i].kind));
        const Spring& s = model.springs[i];
        const double now = glm::length(at(model.positions, s.b) - at(model.positions, s.a));
        EXPECT_NEAR(now, s.restLength, 1e-14);  // coordinates of about 3 carry 4e-16
    }
    EXPECT_EQ(lengths.size(), 5U);
}

TEST(ClothBuilder, UniformLumpingHalvesNothing) {
    ClothShape shape = flag(6, 4);
    shape.material.lumping = Lumping::uniform;
    const Model model = buildCloth(shape);
    EXPECT_EQ(model.springs[0].stiffness, model.springs[6 * 2].stiffness);
    shape.material.lumping = Lumping::weighted;
    const Model weighted = buildCloth(shape);
    EXPECT_EQ(2.0 * weighted.springs[0].stiffness, weighted.springs[6 * 2].stiffness);
}

TEST(ClothBuilder, TrianglesCoverItAndFaceForward) {
    const Model model = buildCloth(flag(6, 4));
    glm::dvec3 area(0.0);
    for (const auto& [a, b, c] : model.triangles) {
        const glm::dvec3 n = 0.5 * glm::cross(at(model.positions, b) - at(model.positions, a),
                                              at(model.positions, c) - at(model.positions, a));
        EXPECT_GT(n.z, 0.0);
        area += n;
    }
    EXPECT_NEAR(area.z, 1.8 * 1.2, clothRounding);
    EXPECT_EQ(model.triangles.size(), 48U);
}

// Cells of which the middle lies in a circle: about π/4 of all (Gauss's circle problem).
TEST(ClothBuilder, RoundOneHasWhatTheCellsInTheEllipseHave) {
    ClothShape shape = flag(60, 40);
    shape.isRound = true;
    shape.material.rigidity = {1e-5, 1e-5, 0, 1e-5};
    const Model model = buildCloth(shape);
    const auto cells = static_cast<double>(model.triangles.size()) / 2;
    EXPECT_NEAR(cells / 2400, 0.7854, 0.005);
    EXPECT_NEAR(totalMass(model), 0.2 * cells * 0.03 * 0.03, 1e-6 * totalMass(model));
    std::set<int> used;
    for (const auto& triangle : model.triangles) used.insert(triangle.begin(), triangle.end());
    EXPECT_TRUE(std::equal(used.begin(), used.end(), model.groups.at("all").begin(), model.groups.at("all").end()));
    for (const Spring& s : model.springs) EXPECT_TRUE(used.contains(s.a) && used.contains(s.b));
    int terms = 0;
    eachTerm(model.bending, [&](const BendingTerm& term) {
        ++terms;
        for (int k = 0; k < term.count; ++k) EXPECT_TRUE(used.contains(term.points[k]));
    });
    EXPECT_NEAR(terms, 3 * cells, 0.1 * terms);  // two folds and a twist a cell, but for the hem
    for (int p = 0; p < model.pointCount(); ++p) EXPECT_EQ(model.held[p], !used.contains(p));
}

TEST(ClothBuilder, GroupsAreWhereTheirNamesSay) {
    const Model model = buildCloth(flag(3, 2));
    EXPECT_EQ(model.groups.at("left"), (std::vector<int>{0, 4, 8}));
    EXPECT_EQ(model.groups.at("right"), (std::vector<int>{3, 7, 11}));
    EXPECT_EQ(model.groups.at("top"), (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(model.groups.at("bottom"), (std::vector<int>{8, 9, 10, 11}));
    EXPECT_EQ(model.groups.at("corners"), (std::vector<int>{0, 3, 8, 11}));
    EXPECT_EQ(model.groups.at("bottom-right"), std::vector<int>{11});
    EXPECT_EQ(model.groups.at("top-right"), std::vector<int>{3});
    EXPECT_EQ(model.groups.at("edges"), (std::vector<int>{0, 1, 2, 3, 4, 7, 8, 9, 10, 11}));
    EXPECT_EQ(model.grid, (std::array<int, 2>{3, 2}));
    EXPECT_EQ(model.positions[11], glm::dvec3(0.3 + 1.8, 3.0 - 1.2, -1.0));
}

}  // namespace
}  // namespace taut::mechanics
