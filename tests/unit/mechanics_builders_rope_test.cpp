#include <gtest/gtest.h>

#include <algorithm>

#include "mechanics_lattice_facts.h"
#include "taut/core/error.h"
#include "taut/mechanics/builders.h"

namespace taut::mechanics {
namespace {

using namespace test;

// Sums of a few hundred terms of about the same size.
constexpr double ropeRounding = 1e-12;

double chord(const Model& model, int i) {
    return glm::length(at(model.positions, i + 1) - at(model.positions, i));
}

TEST(RopeBuilder, MassIsTheRopesForEveryResolutionAndLumping) {
    for (int segments : {1, 2, 7, 40})
        for (Lumping lumping : {Lumping::weighted, Lumping::uniform}) {
            RopeShape shape;
            shape.segments = segments;
            shape.mass = 2.5;
            shape.lumping = lumping;
            const Model model = buildRope(shape);
            EXPECT_EQ(brokenRule(model), "");
            EXPECT_EQ(model.pointCount(), segments + 1);
            EXPECT_NEAR(totalMass(model), 2.5, 2.5 * ropeRounding);
            EXPECT_NEAR(centreOfMass(model).x, 0.5, ropeRounding);
        }
}

TEST(RopeBuilder, SpringsInARowHaveTheRopesStiffness) {
    for (int segments : {1, 8, 64}) {
        RopeShape shape;
        shape.end = {0.0, -3.0, 0.0};
        shape.segments = segments;
        shape.stretch = 600.0;
        double compliance = 0.0;
        for (const Spring& s : buildRope(shape).springs) compliance += 1.0 / s.stiffness;
        EXPECT_NEAR(1.0 / compliance, 600.0 / 3.0, 200.0 * ropeRounding);
    }
}

// Link i from the lower end carries (i + ½) M/n; the sum of their extensions is MgL/2EA for every n.
TEST(RopeBuilder, HangingByItsOwnWeightStretchesByHalfMgLOverEa) {
    RopeShape shape;
    shape.end = {0.0, -2.0, 0.0};
    shape.segments = 13;
    shape.mass = 0.7;
    shape.stretch = 500.0;
    const Model model = buildRope(shape);
    double below = 0.0, extension = 0.0;
    for (int i = shape.segments - 1; i >= 0; --i) {
        below += model.masses[static_cast<std::size_t>(i) + 1];
        extension += below * 9.81 / model.springs[i].stiffness;
    }
    EXPECT_NEAR(extension, 0.7 * 9.81 * 2.0 / (2.0 * 500.0), ropeRounding);
}

TEST(RopeBuilder, SpringsOfAKindShareOneRestLength) {
    RopeShape shape;
    shape.segments = 7;
    shape.end = {0.1, 0.7, -0.3};
    shape.bend = 20.0;
    const Model model = buildRope(shape);
    ASSERT_EQ(model.springs.size(), 7U + 6U);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(model.springs[i].restLength, model.springs[0].restLength);
    for (std::size_t i = 7; i < 13; ++i) {
        EXPECT_EQ(model.springs[i].kind, SpringKind::bend);
        EXPECT_EQ(model.springs[i].restLength, 2.0 * model.springs[0].restLength);
        EXPECT_EQ(model.springs[i].stiffness, 20.0 / model.springs[i].restLength);
    }
}

TEST(RopeBuilder, SlackHangsWithoutStrain) {
    for (double slack : {1.0001, 1.05, 1.3, 2.0, 4.0})
        for (int segments : {2, 3, 10, 41}) {
            RopeShape shape;
            shape.start = {-1.0, 2.0, 0.5};
            shape.end = {1.0, 2.5, 0.0};
            shape.segments = segments;
            const double distance = glm::length(shape.end - shape.start);
            shape.length = slack * distance;
            const Model model = buildRope(shape);
            EXPECT_EQ(brokenRule(model), "");
            EXPECT_EQ(model.positions.front(), shape.start);
            EXPECT_EQ(model.positions.back(), shape.end);
            double sum = 0.0;
            for (int i = 0; i < segments; ++i) {
                sum += chord(model, i);
                // All but the last are made with that length; the last closes a fit that is good to 1e-12 or so.
                EXPECT_NEAR(chord(model, i), shape.length / segments, 1e-9 * shape.length / segments)
                    << "slack " << slack << " segments " << segments << " link " << i;
            }
            EXPECT_NEAR(sum, shape.length, 1e-9 * shape.length);
        }
}

TEST(RopeBuilder, SlackHangsBelowItsEndsAndIsSymmetric) {
    RopeShape shape;
    shape.segments = 20;
    shape.length = 1.4;
    const Model model = buildRope(shape);
    for (int i = 1; i < 20; ++i) {
        EXPECT_LT(at(model.positions, i).y, 0.0);
        EXPECT_EQ(at(model.positions, i).z, 0.0);
        // Laid from the start: the rounding of the fit adds up along it.
        EXPECT_NEAR(at(model.positions, i).y, at(model.positions, 20 - i).y, 1e-10);
        EXPECT_NEAR(at(model.positions, i).x + at(model.positions, 20 - i).x, 1.0, 1e-10);
    }
}

// In the catenary the pull of two neighbouring links on a point differs by its weight alone: level tension H is the
// same in all links, and each point changes the steep part by m g.
TEST(RopeBuilder, SlackHangsInBalance) {
    RopeShape shape;
    shape.end = {1.0, 0.4, 0.3};
    shape.segments = 15;
    shape.length = 1.6;
    const Model model = buildRope(shape);
    std::vector<double> slopes;
    for (int i = 0; i < 15; ++i) {
        const glm::dvec3 d = at(model.positions, i + 1) - at(model.positions, i);
        slopes.push_back(d.y / glm::length(glm::dvec2(d.x, d.z)));
    }
    for (std::size_t i = 1; i + 1 < slopes.size(); ++i)
        EXPECT_NEAR(slopes[i + 1] - slopes[i], slopes[i] - slopes[i - 1], 1e-8);  // slopes of a fit good to 1e-12
}

TEST(RopeBuilder, SlackAlongTheSagBowsOutSideways) {
    RopeShape shape;
    shape.end = {0.0, -1.0, 0.0};
    shape.segments = 12;
    shape.length = 1.2;
    const Model model = buildRope(shape);
    for (int i = 0; i < 12; ++i) EXPECT_NEAR(chord(model, i), 0.1, 1e-8);
}

TEST(RopeBuilder, EndsInOnePlaceMakeARing) {
    for (int segments : {2, 3, 9}) {
        RopeShape shape;
        shape.end = shape.start;
        shape.segments = segments;
        shape.length = 3.0;
        const Model model = buildRope(shape);
        for (int i = 0; i < segments; ++i) EXPECT_NEAR(chord(model, i), 3.0 / segments, ropeRounding);
        for (const glm::dvec3& p : model.positions) EXPECT_LE(p.y, 0.0);
    }
}

TEST(RopeBuilder, ShorterThanItsDistanceIsTautAndEven) {
    RopeShape shape;
    shape.length = 0.8;
    shape.segments = 5;
    const Model model = buildRope(shape);
    for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(chord(model, i), 0.2, ropeRounding);
        EXPECT_EQ(model.springs[i].restLength, 0.8 / 5);
    }
}

TEST(RopeBuilder, WithoutLengthOrDistanceIsAnError) {
    RopeShape shape;
    shape.end = shape.start;
    EXPECT_THROW(buildRope(shape), core::Error);
}

TEST(RopeBuilder, GroupsAreItsEnds) {
    RopeShape shape;
    shape.segments = 3;
    const Model model = buildRope(shape);
    EXPECT_EQ(model.groups.at("start"), std::vector<int>{0});
    EXPECT_EQ(model.groups.at("end"), std::vector<int>{3});
    EXPECT_EQ(model.groups.at("ends"), (std::vector<int>{0, 3}));
}

// Catmull and Rom's curve through places on a straight line stays on it, and through places that lie mirrored it is
// mirrored; its links have their natural length.
TEST(RopeBuilder, LaidThroughPlacesItGoesThroughThemUnstretched) {
    RopeShape shape;
    shape.start = {-1.0, 0.0, 0.0};
    shape.end = {1.0, 0.0, 0.0};
    shape.segments = 200;
    shape.through = {{-0.5, 0.3, 0.1}, {0.0, 0.5, 0.0}, {0.5, 0.3, -0.1}};
    const Model model = buildRope(shape);
    EXPECT_EQ(brokenRule(model), "");
    for (const Spring& s : model.springs) EXPECT_NEAR(chord(model, s.a), s.restLength, 1e-9);
    for (const glm::dvec3& place : shape.through) {
        double nearest = 1.0;
        for (const glm::dvec3& p : model.positions) nearest = std::min(nearest, glm::length(p - place));
        EXPECT_LT(nearest, 0.5 * model.springs.front().restLength * 1.01);
    }
    const glm::dvec3 quarter = at(model.positions, 50), mirrored = at(model.positions, 150);
    EXPECT_LT(glm::length(mirrored - glm::dvec3(-quarter.x, quarter.y, -quarter.z)), 1e-9);
    EXPECT_EQ(at(model.positions, 0), shape.start);
    EXPECT_EQ(at(model.positions, 200), shape.end);
}

// Level, around the diameter between its ends; or through places, back to where it began. Every point has two
// neighbours.
TEST(RopeBuilder, ClosedItIsAnUnstretchedRing) {
    for (const bool isLoop : {false, true}) {
        RopeShape shape;
        shape.start = {-1.0, 2.0, 0.0};
        shape.end = {1.0, 2.0, 0.0};
        shape.segments = 40;
        shape.bend = 1.0;
        shape.isClosed = true;
        if (isLoop) shape.through = {{0.0, 2.0, 1.5}};
        const Model model = buildRope(shape);
        EXPECT_EQ(brokenRule(model), "");
        ASSERT_EQ(model.pointCount(), 40);
        std::vector<int> neighbours(40, 0);
        for (const Spring& s : model.springs) {
            if (s.kind != SpringKind::structural) continue;
            ++neighbours[s.a];
            ++neighbours[s.b];
            EXPECT_NEAR(glm::length(at(model.positions, s.b) - at(model.positions, s.a)), s.restLength, 1e-9);
        }
        for (const int count : neighbours) EXPECT_EQ(count, 2);
        EXPECT_LT(glm::length(at(model.positions, model.groups.at("start")[0]) - shape.start), 1e-9);
        EXPECT_LT(glm::length(at(model.positions, model.groups.at("end")[0]) - shape.end),
                  0.51 * model.springs.front().restLength);
        if (isLoop) continue;
        EXPECT_EQ(model.groups.at("end")[0], 20);
        for (const glm::dvec3& p : model.positions)
            EXPECT_NEAR(glm::length(p - glm::dvec3(0, 2, 0)), 1.0, ropeRounding);
    }
}

}  // namespace
}  // namespace taut::mechanics
