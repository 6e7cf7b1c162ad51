#include "taut/spec/spec.h"
#include "taut/study/problems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "taut/bodies/net.h"
#include "taut/ode/method_table.h"
#include "taut/study/errors.h"
#include "taut/study/horizon.h"
#include "taut/study/mechanical_subject.h"
#include "taut/study/scene_subject.h"

namespace taut::study {
namespace {

TEST(StudyProblems, HaveTheirOwnNames) {
    std::set<std::string> names;
    for (const ProblemInfo& problem : problems()) {
        EXPECT_EQ(problem.make()->name(), problem.name);
        EXPECT_TRUE(names.insert(std::string(problem.name)).second) << problem.name;
        EXPECT_EQ(findProblem(problem.name), &problem);
    }
    EXPECT_EQ(findProblem("no such"), nullptr);
}

TEST(StudyProblems, StartWhereTheirSolutionsStart) {
    for (const ProblemInfo& info : problems()) {
        const std::unique_ptr<Subject> problem = info.make();
        const std::optional<Observation> exact = problem->exact(0.0);
        if (!exact) continue;
        RunPlan plan;
        plan.method = "rk4";
        plan.grid = problem->grid(problem->duration(), problem->duration());
        const Observation start = problem->begin(plan)->observe();
        // The same formula evaluated at zero, positions of about a metre: a few roundings.
        EXPECT_LT(maxDifference(start.values, exact->values, problem->dimensions()), 1e-15) << info.name;
        EXPECT_GE(plan.grid.samples, 10) << info.name;
    }
}

TEST(StudyProblems, StepsHitTheSampleTimes) {
    const std::unique_ptr<Subject> problem = makeProblem("oscillator");
    const Grid grid = problem->grid(5.0, 5.0);
    const long long each = stepsPerSample(*problem, grid, 0.013);
    EXPECT_LE(grid.spacing / static_cast<double>(each), 0.013);
    EXPECT_GT(grid.spacing / static_cast<double>(each - 1), 0.013);
    EXPECT_EQ(problem->grid(5.0, 0.5).samples, 100);  // ten within the window
}

TEST(StudyProblems, AHeldPointAndAFreeOneCountAsOne) {
    const std::unique_ptr<Subject> problem = makeProblem("oscillator");
    RunPlan plan;
    plan.method = "leapfrog";
    plan.grid = {0.1, 10};
    EXPECT_EQ(problem->begin(plan)->observe().values.size(), 3U);
}

// Two masses on strings, released from above the horizontal: the text-book chaos.
std::unique_ptr<Subject> doublePendulum() {
    MechanicalProblem problem;
    problem.name = "double-pendulum";
    problem.duration = 8;
    mechanics::Model& model = problem.model;
    model.positions = {{0, 0, 0}, {0.8, 0.6, 0.1}, {1.1, 1.5, 0.0}};
    model.velocities.assign(3, glm::dvec3(0.0));
    model.masses.assign(3, 1.0);
    model.dragRates.assign(3, 0.0);
    model.held = {true, false, false};
    model.springs = {{0, 1, 4000.0, 1.0, 0.0}, {1, 2, 4000.0, 1.0, 0.0}};
    return makeMechanicalSubject(std::move(problem));
}

TEST(StudyHorizon, ChaosEndsItAndCalmDoesNot) {
    const std::unique_ptr<Subject> chaos = doublePendulum(), calm = makeProblem("oscillator");
    const Horizon wild = findHorizon(*chaos, 8.0), still = findHorizon(*calm, 8.0);
    EXPECT_TRUE(wild.isReached);
    EXPECT_LT(wild.seconds, 8.0);
    EXPECT_GT(wild.seconds, 0.0);
    EXPECT_FALSE(still.isReached);
    EXPECT_DOUBLE_EQ(still.seconds, 8.0);
    // A linear oscillator keeps |shift|² = d² cos² + … ≤ d²; rounding of the start, 1e-16 against 1e-9, adds nothing.
    EXPECT_LE(still.growth, 1.001);
}

constexpr double omega = 6.0;

// A mass on a nail by a spring of zero rest length is the oscillator of the built-in problem, written as a scene.
world::SceneSpec oscillatorScene() {
    world::SceneSpec scene;
    scene.world.gravity = {0.0, 0.0, 0.0};
    scene.run.seconds = 1.0;
    world::NetSpec net;
    net.name = "spring";
    net.dampingTime = 0.0;
    net.drag = 0.0;
    net.points = {{"nail", {0, 0, 0}, 1.0, true, {}}, {"bob", {1.0, 0.5, -0.25}, 1.0, false, {}}};
    world::NetSpringSpec spring;
    spring.a = "nail";
    spring.b = "bob";
    spring.stiffness = omega * omega;
    spring.restLength = 0.0;
    net.springs = {spring};
    scene.bodies.add(net);
    return scene;
}

TEST(StudyScene, IsIntegratedAsTheSameSystemIs) {
    const std::unique_ptr<Subject> scene = makeSceneSubject(oscillatorScene(), "scene"),
                                   direct = makeProblem("oscillator");
    for (const ode::MethodInfo& method : ode::methods()) {
        RunPlan plan;
        plan.method = method.name;
        plan.grid = scene->grid(1.0, 1.0);
        plan.stepsPerSample = stepsPerSample(*scene, plan.grid, 1.0 / 240);
        ASSERT_EQ(plan.grid.samples, 10);
        const std::unique_ptr<Trial> a = scene->begin(plan), b = direct->begin(plan);
        for (int i = 0; i < plan.grid.samples; ++i) {
            ASSERT_TRUE(a->advance() && b->advance()) << method.name;
            const Observation seen = a->observe(), same = b->observe();
            // The same operations but for the rounding of h = tick/substeps, 1e-16 of 240 steps; a solver stops at a
            // residual of 1e-5 of its right-hand side from starts that may differ in the last bit.
            EXPECT_LT(maxDifference(seen.values, same.values, 3), 1e-12) << method.name << " " << i;
            EXPECT_NEAR(seen.energy, same.energy, 1e-11) << method.name << " " << i;
        }
        EXPECT_GT(a->work().evaluations, 0) << method.name;
    }
}

TEST(StudyScene, PerturbationMovesEveryCoordinateALittle) {
    const std::unique_ptr<Subject> scene = makeSceneSubject(oscillatorScene(), "scene");
    RunPlan plan;
    plan.method = "rk4";
    plan.grid = scene->grid(1.0, 1.0);
    plan.stepsPerSample = scene->quantum(plan.grid);
    const std::vector<double> still = scene->begin(plan)->observe().values;
    plan.perturbation = 1e-6;
    const std::vector<double> moved = scene->begin(plan)->observe().values;
    ASSERT_EQ(still.size(), 3U);
    for (std::size_t p = 0; p < 3; ++p) {
        EXPECT_NE(still[p], moved[p]);
        EXPECT_LE(std::abs(still[p] - moved[p]), 1e-6);
    }
}

// ω is 6/s exactly, so that leap-frog's limit is 2/6 s; B1 of one spring at a held point is ω itself.
TEST(StudyScene, TellsTheLimitOfEachMethod) {
    const std::unique_ptr<Subject> scene = makeSceneSubject(oscillatorScene(), "scene");
    EXPECT_NEAR(scene->stepLimit(*ode::findMethod("leapfrog")), 2.0 / omega, 1e-12);
    EXPECT_NEAR(makeProblem("oscillator")->stepLimit(*ode::findMethod("rk4")), 2.0 * std::sqrt(2.0) / omega, 1e-6);
    EXPECT_EQ(makeProblem("oscillator")->stepLimit(*ode::findMethod("euler")), 0.0);
}

}  // namespace
}  // namespace taut::study
