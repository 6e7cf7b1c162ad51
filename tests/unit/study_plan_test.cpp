// The need, the model and the changes of the file of a plan, without a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/small_scenes.h"
#include "support/text.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"
#include "taut/forces/wind.h"
#include "taut/scene/private/by_key.h"
#include "taut/study/plan_candidate.h"
#include "taut/study/plan_changes.h"
#include "taut/study/plan_need.h"
#include "taut/study/plan_run.h"

namespace taut::study {
namespace {

using test::has;

world::SceneSpec sceneWithNeed() {
    world::SceneSpec scene;
    scene.file = "s.toml";
    scene.need.rmsPosition = 2e-3;
    scene.need.horizon = 0.5;
    scene.bodies.add(support::cloth("c", 12));
    scene.bodies.of<world::ClothSpec>().back().cells = {12, 8};
    scene.bodies.of<world::ClothSpec>().back().hold = {"top"};
    return scene;
}

std::string planRefusal(const world::SceneSpec& scene) {
    try {
        checkNeed(scene);
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        return error.what();
    }
    return "";
}

TEST(PlanNeed, AMissingOneIsExplainedByAnExample) {
    world::SceneSpec scene = sceneWithNeed();
    scene.need = {};
    const std::string message = planRefusal(scene);
    EXPECT_TRUE(has(message, "s.toml: error: ")) << message;
    EXPECT_TRUE(has(message, "[need]\n    rms_position_m = ")) << message;
}

TEST(PlanNeed, WithoutAnAccuracyItIsRefused) {
    world::SceneSpec scene = sceneWithNeed();
    scene.need.rmsPosition.reset();
    EXPECT_TRUE(has(planRefusal(scene), "no accuracy of the positions"));
}

TEST(PlanNeed, AHorizonBeyondTheRunContradictsIt) {
    world::SceneSpec scene = sceneWithNeed();
    scene.run.seconds = 0.4;
    EXPECT_TRUE(has(planRefusal(scene), "horizon_s = 0.5 is later than the end of the run at 0.4 s"));
    scene.run.seconds = 0.5;
    EXPECT_EQ(planRefusal(scene), "");
}

TEST(PlanNeed, OfSeveralTargetsTheStrictestCounts) {
    world::SceneSpec scene = sceneWithNeed();
    EXPECT_EQ(resolvedNeed(scene, {3.0, 1e-3}).target, 2e-3);
    scene.need.rmsPercent = 0.1;
    EXPECT_EQ(resolvedNeed(scene, {1.0, 1e-3}).target, 1e-3) << "0.1 % of a metre";
    EXPECT_EQ(resolvedNeed(scene, {3.0, 1e-3}).target, 2e-3) << "0.1 % of three metres are more";
    scene.need.rmsPixels = 0.5;
    EXPECT_EQ(resolvedNeed(scene, {1.0, 1e-3}).target, 0.5e-3);
}

TEST(PlanNeed, PixelsThatShowNothingAreRefused) {
    world::SceneSpec scene = sceneWithNeed();
    scene.need.rmsPosition.reset();
    scene.need.rmsPixels = 1.0;
    EXPECT_THROW((void)resolvedNeed(scene, {1.0, 0.0}), core::Error);
}

TEST(PlanModel, AllEdgesGoWithTheLongest) {
    const world::SceneSpec scene = sceneWithNeed();
    const Resolution resolution = resolutionOf(scene);
    ASSERT_EQ(resolution.count, 12);
    Candidate candidate;
    candidate.count = 6;
    EXPECT_EQ(modelOf(scene, resolution, candidate).bodies.of<world::ClothSpec>()[0].cells, glm::ivec2(6, 4));
    candidate.count = 2;
    EXPECT_EQ(modelOf(scene, resolution, candidate).bodies.of<world::ClothSpec>()[0].cells, glm::ivec2(2, 2))
        << "two at least";
}

TEST(PlanModel, BodiesWithTiedPointsKeepTheirCells) {
    world::SceneSpec scene = sceneWithNeed();
    scene.bodies.of<world::ClothSpec>()[0].hold = {"#3"};
    scene.bodies.add(support::rope("a", {0, 2, 0}, {1, 2, 0}, 20));
    scene.bodies.add(support::rope("b", {0, 2, 1}, {1, 2, 1}, 10));
    scene.joints = {support::weld("rope.a@end", "rope.a@end")};
    const Resolution resolution = resolutionOf(scene);
    EXPECT_EQ(resolution.scalable, std::vector<std::string>{"rope.b"});
    EXPECT_EQ(resolution.count, 10);
    EXPECT_TRUE(has(resolution.fixed.at("cloth.c"), "held at single points"));
    EXPECT_TRUE(has(resolution.fixed.at("rope.a"), "joint"));
}

// Layers keep 0.02 m, the cells of a square metre are 1/12 of it and more.
TEST(PlanModel, CellsOfBodiesThatTouchAreNotSmallerThanTheyKeepApart) {
    world::SceneSpec scene = sceneWithNeed();
    EXPECT_GT(resolutionOf(scene).most, 1000000);
    scene.bodies.of<world::ClothSpec>()[0].touch = world::Touch::all;
    scene.bodies.of<world::ClothSpec>()[0].thickness = 0.01;
    EXPECT_EQ(resolutionOf(scene).most, 50);
    scene.bodies.of<world::ClothSpec>()[0].thickness = 0.1;
    EXPECT_EQ(resolutionOf(scene).most, 12) << "as written they may be";
}

TEST(PlanModel, EveryGeneratorIsListedAndCanBeLeftOut) {
    world::SceneSpec scene = sceneWithNeed();
    scene.bodies.of<world::ClothSpec>()[0].material = "m";
    scene.materials["m"] = {};
    world::BlockSpec block;
    block.name = "b";
    block.bulk = 2e4;
    scene.bodies.add(block);
    scene.forces.add(world::WindSpec{});
    scene.forces.of<world::WindSpec>()[0].name = "w";
    std::vector<std::string> names;
    for (const Generator& generator : generatorsOf(scene)) {
        names.push_back(generator.name);
        scene::eachNumber(scene, generator.owner, generator.keys, [](double& strength) { strength = 0; });
    }
    EXPECT_EQ(names, (std::vector<std::string>{"wind w", "drag", "inner friction", "bend springs", "volume terms"}));
    EXPECT_TRUE(generatorsOf(scene).empty()) << "without them there are none left";
}

TEST(PlanModel, AFabricOfTheLibraryStaysAsItIs) {
    world::SceneSpec scene = sceneWithNeed();
    scene.materials["fabric:silk"] = scene.materials["mine"] = {};
    Candidate candidate;
    candidate.count = 12;
    candidate.without = generatorsOf(scene);
    const world::SceneSpec model = modelOf(scene, resolutionOf(scene), candidate);
    EXPECT_EQ(model.materials.at("mine").drag, 0);
    EXPECT_GT(model.materials.at("fabric:silk").drag, 0);
    scene.materials.erase("mine");
    EXPECT_TRUE(generatorsOf(scene).empty());
}

TEST(PlanRuns, ClothsOfOtherCellsAreSeenAtTheSamePlaces) {
    const world::SceneSpec scene = sceneWithNeed();
    const Resolution resolution = resolutionOf(scene);
    PlanGrid grid;
    grid.samples = 1;
    Candidate coarse, fine;
    coarse.count = 5;
    fine.count = 16;
    world::SceneSpec a = modelOf(scene, resolution, coarse), b = modelOf(scene, resolution, fine);
    a.world.gravity = b.world.gravity = {0, 0, 0};  // flat and at rest: interpolation is exact
    // 1e-12: rounding of coordinates of a metre, 2e-16 an operation.
    EXPECT_LT(difference(play(a, resolution, grid), play(b, resolution, grid)), 1e-12);
}

// A cloth that is thrown at a plane, off which it bounces.
TEST(PlanRuns, KnowOfContactsThatAreOverAtTheEnd) {
    world::SceneSpec scene = sceneWithNeed();
    world::ClothSpec& cloth = scene.bodies.of<world::ClothSpec>().back();
    cloth.hold = {};
    cloth.origin = {0, 4, 0};
    cloth.velocity = {0, -12, 0};
    world::ColliderSpec plane;
    plane.name = "plane";
    plane.shape = "plane";
    plane.position = {0, 2, 0};
    plane.restitution = 1.0;
    scene.colliders = {plane};
    PlanGrid grid;
    grid.samples = 30;
    EXPECT_TRUE(play(scene, resolutionOf(scene), grid).hasContacts);
}

TEST(PlanRuns, CountSpringsTimesEvaluations) {
    const world::SceneSpec scene = sceneWithNeed();
    const Resolution resolution = resolutionOf(scene);
    PlanGrid grid;
    grid.samples = 3;
    Candidate candidate;
    candidate.count = 4;
    candidate.method = "rk4";
    const world::SceneSpec model = modelOf(scene, resolution, candidate);
    const StepFacts facts = stepFacts(model);
    const PlanRun run = play(model, resolution, grid);
    ASSERT_TRUE(run.hasEnded());
    // RK4 evaluates four times a step.
    EXPECT_EQ(run.cost, facts.cost * 4 * facts.leastSubsteps * 3);
}

TEST(PlanRuns, CountContactBetweenBodies) {
    world::SceneSpec scene = sceneWithNeed();
    const Resolution resolution = resolutionOf(scene);
    PlanGrid grid;
    const double alone = play(scene, resolution, grid).cost;
    scene.bodies.of<world::ClothSpec>()[0].touch = world::Touch::all;
    const PlanRun run = play(scene, resolution, grid);
    EXPECT_GT(run.cost, alone);
    EXPECT_GT(run.effort - run.cost, 0);
}

TEST(PlanRuns, DoNotCountTheStart) {
    const world::SceneSpec scene = sceneWithNeed();
    const Resolution resolution = resolutionOf(scene);
    PlanGrid grid;
    grid.samples = 3;
    Candidate candidate;
    candidate.count = 4;  // leap-frog: one evaluation a step, and one to start
    const world::SceneSpec model = modelOf(scene, resolution, candidate);
    const StepFacts facts = stepFacts(model);
    EXPECT_EQ(play(model, resolution, grid).cost, facts.cost * facts.leastSubsteps * 3);
}

TEST(PlanRuns, EndAtTheHorizonItself) {
    const world::SceneSpec scene = sceneWithNeed();
    for (const int ticks : {1, 7, 10, 25, 29, 60}) {
        const PlanGrid grid = planGrid(scene, ticks / 60.0);
        EXPECT_EQ(grid.ticks(), ticks);
        EXPECT_GE(grid.samples, std::min(ticks, 10));
    }
}

TEST(PlanRuns, StepsAreAsManyAsAskedFor) {
    const world::SceneSpec scene = sceneWithNeed();
    const Resolution resolution = resolutionOf(scene);
    Candidate candidate;
    candidate.count = 4;
    for (const int substeps : {7, 13, 50, 333}) {
        world::SceneSpec model = modelOf(scene, resolution, candidate);
        setSubsteps(model, stepFacts(model), substeps);
        EXPECT_EQ(stepFacts(model).leastSubsteps, substeps);
    }
}

TEST(PlanRuns, TwoIslandsShrinkTheirStepsByTheSameShare) {
    world::SceneSpec scene = sceneWithNeed();
    scene.bodies.add(support::rope("stiff", {0, 2, 0}, {1, 2, 0}, 20));
    scene.bodies.of<world::RopeSpec>().back().stretch = 1e6;
    const Resolution resolution = resolutionOf(scene);
    Candidate candidate;
    candidate.count = resolution.count;
    world::SceneSpec model = modelOf(scene, resolution, candidate);
    const StepFacts facts = stepFacts(model);
    setSubsteps(model, facts, 2 * facts.leastSubsteps);
    EXPECT_FALSE(model.solver.dt.has_value());
    EXPECT_EQ(stepFacts(model).leastSubsteps, 2 * facts.leastSubsteps);
}

TEST(PlanChanges, NameWhatDiffersAndNothingElse) {
    world::SceneSpec scene = sceneWithNeed();
    scene.bodies.of<world::ClothSpec>()[0].material = "m";
    scene.materials["m"] = {};
    EXPECT_TRUE(planChanges(scene, scene).empty());
    world::SceneSpec planned = scene;
    planned.bodies.of<world::ClothSpec>()[0].cells = {6, 4};
    planned.materials["m"].bend = 0;
    planned.solver.integrator = "rk4";
    planned.solver.dt = 1e-3;
    planned.solver.precision = world::Precision::double_;
    std::string all;
    for (const scene::Change& change : planChanges(scene, planned)) all += change.key + " = " + change.value + "\n";
    EXPECT_EQ(all,
              "cloth.c.cells = [6, 4]\nmaterial.m.bend_N_per_m = 0.0\nsolver.integrator = \"rk4\"\n"
              "solver.dt = 0.001\nsolver.precision = \"double\"\n");
}

TEST(PlanChanges, ReachBodiesWithASolverOfTheirOwn) {
    world::SceneSpec scene = sceneWithNeed();
    scene.bodies.of<world::ClothSpec>()[0].solver.integrator = "heun";
    world::SceneSpec planned = scene;
    planned.bodies.of<world::ClothSpec>()[0].solver = {};
    const std::vector<scene::Change> changes = planChanges(scene, planned);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].key, "cloth.c.solver.integrator");
    EXPECT_EQ(changes[0].value, "\"leapfrog\"");
}

}  // namespace
}  // namespace taut::study
