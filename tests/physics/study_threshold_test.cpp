// Thresholds found by bisection against theory and bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/dense_stiffness.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/mechanics/builders.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/study/threshold.h"

namespace taut::test::study_threshold {
namespace {

using study::MethodThreshold;
using study::SceneThresholds;
using study::ThresholdKind;

SceneThresholds thresholdsOf(const world::SceneSpec& spec, std::vector<std::string> methods) {
    study::ThresholdSettings settings;
    settings.methods = std::move(methods);
    settings.seconds = 0.4;
    return study::findThresholds(spec, "test", settings);
}

// The stable step is within 1 % of the failing one; growth from 1e-9 m within 0.4 s, some 250 steps, takes 8 % a step,
// which leap-frog has 0.1 % above its limit, and RK4, whose roots leave the circle slowly, 1.5 %.
TEST(Threshold, OfATautRopeIsThatOfTheClosedForm) {
    const SceneThresholds found =
        thresholdsOf(study::referenceNetwork("rope"), {"symplectic-euler", "velocity-verlet", "leapfrog", "rk4"});
    ASSERT_EQ(found.islands.size(), 1U);
    const double omega = found.islands[0].closedForm;
    EXPECT_EQ(found.methods.size(), 4U);
    for (const MethodThreshold& method : found.methods) {
        SCOPED_TRACE(method.method);
        const double z = method.method == "rk4" ? 2 * std::sqrt(2.0) : 2.0;
        EXPECT_EQ(method.kind, ThresholdKind::found);
        EXPECT_NEAR(method.predicted.closedForm, z / omega, 1e-6 * z / omega);  // bisected to a few bits, or a formula
        EXPECT_LT(method.stands, method.fails);
        EXPECT_LE(method.fails, 1.01 * method.stands);
        EXPECT_GT(method.fails, z / omega);
        EXPECT_LT(method.stands, 1.02 * z / omega);
        EXPECT_GE(method.fails, method.predicted.boundAnywhere);  // a bound is never above the threshold
        EXPECT_EQ(method.limitedBy, "rope.line");
    }
}

TEST(Threshold, OfAClothLiesBetweenItsBoundsAndTheEndlessGrid) {
    const SceneThresholds found = thresholdsOf(study::referenceNetwork("cloth"), {"leapfrog"});
    const MethodThreshold& leapfrog = found.methods.at(0);
    const study::IslandFrequencies& sheet = found.islands.at(0);
    EXPECT_GE(sheet.boundAnywhere, sheet.boundHere);
    EXPECT_GE(leapfrog.fails, leapfrog.predicted.boundAnywhere);
    EXPECT_GE(leapfrog.fails, leapfrog.predicted.boundHere * (1 - 1e-3));
    // Sixteen cells hold nearly the whole fastest wave: cos²(π/34) of its square.
    EXPECT_NEAR(sheet.closedForm / sheet.lanczos, 1, 0.01);
    EXPECT_NEAR(leapfrog.stands / leapfrog.predicted.closedForm, 1, 0.02);  // and 1 % of bisection
}

TEST(Threshold, IsNoneWhereAMethodGrowsAtEveryStepOrAtNone) {
    const SceneThresholds found = thresholdsOf(study::referenceNetwork("rope"), {"euler", "heun", "implicit-euler"});
    const MethodThreshold &euler = found.methods.at(0), &heun = found.methods.at(1), &implicit = found.methods.at(2);
    EXPECT_EQ(euler.kind, ThresholdKind::belowLeast);
    EXPECT_EQ(euler.stands, 0);
    EXPECT_EQ(euler.predicted.closedForm, 0);
    EXPECT_NE(euler.note.find("no threshold"), std::string::npos) << euler.note;
    EXPECT_EQ(heun.kind, ThresholdKind::found);  // as far as can be seen in the time
    EXPECT_NE(heun.note.find("no threshold"), std::string::npos) << heun.note;
    EXPECT_EQ(implicit.kind, ThresholdKind::aboveMost);
    EXPECT_EQ(implicit.stands, found.mostStep);
    EXPECT_TRUE(std::isinf(implicit.predicted.lanczos));
}

// All modes of a straight rope along itself stand h < τ at any frequency, and across they are damped by drag
// alone: there is none, but tension is slight and the run short.
TEST(Threshold, OfExplicitEulerIsTheDampingTime) {
    world::SceneSpec scene = study::referenceNetwork("rope");
    scene.bodies.of<world::RopeSpec>()[0].length = 1.0999;
    scene.bodies.of<world::RopeSpec>()[0].dampingTime = 4e-4;
    const SceneThresholds found = thresholdsOf(scene, {"euler"});
    EXPECT_EQ(found.methods[0].kind, ThresholdKind::found);
    // A step 1 % longer grows by 0.01 τ²ω²/2 a step, 0.1 % for τω = 0.5: in a thousand steps a factor of 3 only, and it
    // takes 1e9: some 10 % above.
    EXPECT_GT(found.methods[0].fails, 0.99 * 4e-4);
    EXPECT_LT(found.methods[0].stands, 1.25 * 4e-4);
}

TEST(ClosedForm, OfARopeIsTheFrequencyOfItsWholeMatrix) {
    const world::SceneSpec scene = study::referenceNetwork("rope");
    const world::RopeSpec& rope = scene.bodies.of<world::RopeSpec>()[0];
    mechanics::Model model = mechanics::buildRope({.start = rope.start,
                                                   .end = rope.end,
                                                   .segments = rope.segments,
                                                   .length = rope.length,
                                                   .mass = rope.mass,
                                                   .stretch = rope.stretch});
    model.held.front() = model.held.back() = true;
    std::string formula;
    const double omega = study::closedFormFrequency(scene, {"rope.line"}, formula);
    EXPECT_NEAR(fastestFrequency(model, model.positions) / omega, 1, 1e-9);  // rounding of the eigenvalues
    EXPECT_FALSE(formula.empty());
}

TEST(ClosedForm, IsNoneWhereTheFormulaDoesNotHold) {
    std::string formula;
    const auto isNone = [&](const auto& change) {
        world::SceneSpec scene = study::referenceNetwork("rope");
        change(scene.bodies.of<world::RopeSpec>()[0]);
        return std::isnan(study::closedFormFrequency(scene, {"rope.line"}, formula));
    };
    EXPECT_FALSE(isNone([](world::RopeSpec&) {}));
    EXPECT_TRUE(isNone([](world::RopeSpec& rope) { rope.bend = 1; }));
    EXPECT_TRUE(isNone([](world::RopeSpec& rope) { rope.length = 1.2; }));
    EXPECT_TRUE(isNone([](world::RopeSpec& rope) { rope.hold = {"start"}; }));
    world::SceneSpec cloth = study::referenceNetwork("cloth");
    cloth.bodies.of<world::ClothSpec>()[0].size.x = 2;
    EXPECT_TRUE(std::isnan(study::closedFormFrequency(cloth, {"cloth.sheet"}, formula)));
    EXPECT_TRUE(std::isnan(study::closedFormFrequency(cloth, {"cloth.sheet", "rope.line"}, formula)));
}

}  // namespace
}  // namespace taut::test::study_threshold
