// What the charts rest on: the solutions in closed form, the computed references, and the orders that come out.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "taut/ode/method_table.h"
#include "taut/study/errors.h"
#include "taut/study/problems.h"
#include "taut/study/reference.h"
#include "taut/study/work_precision.h"

namespace taut::study::study_reference {
namespace {

class ExactProblem : public testing::TestWithParam<const char*> {};

// RK4 with 2000 steps errs by (ωh)⁴/120 a radian: with ωh below 0.13 (chain and net, ω of 126 and 141 a second at h of
// 0.5 ms) times some 130 radians 5e-5 of the smallest amplitude, which is a hundredth of the size; oscillators 1e-10.
TEST_P(ExactProblem, SatisfiesItsEquation) {
    const std::unique_ptr<Subject> problem = findProblem(GetParam())->make();
    RunPlan plan;
    plan.method = "rk4";
    plan.grid = problem->grid(problem->duration(), problem->duration());
    double last = 0;
    for (const long long steps : {400LL, 800LL}) {
        plan.stepsPerSample = steps;
        const std::unique_ptr<Trial> trial = problem->begin(plan);
        double error = 0, energyError = 0;
        for (int i = 1; i <= plan.grid.samples; ++i) {
            ASSERT_TRUE(trial->advance());
            const Observation seen = trial->observe(), exact = *problem->exact(plan.grid.spacing * i);
            error = std::max(error, rmsDifference(seen.values, exact.values, problem->dimensions()));
            if (problem->hasEnergy()) energyError = std::max(energyError, std::abs(seen.energy - exact.energy));
        }
        EXPECT_LT(error, 1e-7) << steps;        // of motions of 1 cm (chain) to 20 m
        EXPECT_LT(energyError, 1e-6) << steps;  // [J] of 0.1 to 50
        // Half the step, a sixteenth of the error, until rounding: the limit of the runs is the solution.
        if (steps > 400 && last > 1e-12) EXPECT_NEAR(last / error, 16.0, 2.0);
        last = error;
    }
}
INSTANTIATE_TEST_SUITE_P(Study, ExactProblem,
                         testing::Values("growth", "quotient", "projectile", "oscillator", "underdamped", "critical",
                                         "overdamped", "chain", "net"));

class ConservativeProblem : public testing::TestWithParam<const char*> {};

// Energies of about a joule, from sums of at most 100 terms: 1e-13 is some roundings of them.
TEST_P(ConservativeProblem, KeepsItsEnergyInClosedForm) {
    const std::unique_ptr<Subject> problem = findProblem(GetParam())->make();
    const double start = problem->exact(0.0)->energy;
    for (int i = 1; i <= 20; ++i)
        EXPECT_NEAR(problem->exact(0.37 * i)->energy, start, 1e-13 * std::max(1.0, std::abs(start)));
}
INSTANTIATE_TEST_SUITE_P(Study, ConservativeProblem, testing::Values("oscillator", "chain", "net"));

TEST(StudyReference, OfThePendulumKeepsItsEnergyAndAgreesWithItself) {
    const std::unique_ptr<Subject> pendulum = makePendulum();
    const Grid grid = pendulum->grid(2.0, 2.0);
    const Reference reference = makeReference(*pendulum, grid, grid.samples, 0.2);
    EXPECT_FALSE(reference.isExact);
    RunPlan plan;
    plan.method = "rk4";
    plan.grid = grid;
    const double start = pendulum->begin(plan)->observe().energy;
    // RK4 at an eighth of a quarter of its limit, ωh < 0.1, keeps energy to 1e-9 of about 10 J.
    for (const Observation& seen : reference.at) EXPECT_NEAR(seen.energy, start, 1e-7);
    EXPECT_LT(reference.difference, 1e-7);
    EXPECT_DOUBLE_EQ(reference.floor, 100 * reference.difference);
}

TEST(StudyReference, ErrorsThatItDoesNotResolveAreMarked) {
    const std::unique_ptr<Subject> pendulum = makePendulum();
    StudySettings settings;
    settings.halvings = 9;
    settings.seconds = 1.0;
    settings.precisions = {Precision::double_};
    settings.methods = {"rk4", "leapfrog"};
    const WorkPrecision study = studyWorkPrecision(*pendulum, settings);
    for (const RunPoint& point : study.points) {
        if (point.status != RunStatus::ok) continue;
        EXPECT_EQ(point.isAtFloor, point.rmsError < 100 * study.reference.difference);
    }
}

class Orders : public testing::TestWithParam<const char*> {};

// The slopes of the charts' own curves are the methods' orders: bounded from both sides by 0.1, in double precision.
TEST_P(Orders, ComeOutOfTheStudy) {
    const std::unique_ptr<Subject> problem = findProblem(GetParam())->make();
    StudySettings settings;
    settings.halvings = 13;
    settings.precisions = {Precision::double_};
    const WorkPrecision study = studyWorkPrecision(*problem, settings);
    for (const MethodFacts& method : study.methods)
        EXPECT_NEAR(measuredOrder(study, method.name, Precision::double_), method.order, 0.1) << method.name;
}
INSTANTIATE_TEST_SUITE_P(Study, Orders,
                         testing::Values("growth", "projectile", "oscillator", "underdamped", "critical",
                                         "overdamped"));

// Euler's limit on cloth is its dashpots', leap-frog's that of its fastest mode: steps below stay bounded.
TEST(StudyCloth, StepsWithinTheLimitNeverFail) {
    const std::unique_ptr<Subject> cloth = makeClothCorners();
    for (const ode::MethodInfo& method : ode::methods()) {
        const double limit = cloth->stepLimit(method);
        if (limit == 0 || !std::isfinite(limit)) continue;
        RunPlan plan;
        plan.method = method.name;
        plan.grid = cloth->grid(0.05, 0.05);
        plan.stepsPerSample = stepsPerSample(*cloth, plan.grid, limit);
        const std::unique_ptr<Trial> trial = cloth->begin(plan);
        for (int i = 0; i < plan.grid.samples; ++i) ASSERT_TRUE(trial->advance()) << method.name;
        EXPECT_LT(trial->observe().kinetic, 0.2 * 9.81 * 0.1) << method.name;  // 0.2 kg has fallen less than 10 cm
    }
}

}  // namespace
}  // namespace taut::study::study_reference
