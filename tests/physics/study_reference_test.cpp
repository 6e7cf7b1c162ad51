// The basis of the charts: the solutions in closed form, the computed references, and the orders that come out.
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <string>

#include "taut/bodies/net.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/study/errors.h"
#include "taut/study/fehlberg78.h"
#include "taut/study/problems.h"
#include "taut/study/reference.h"
#include "taut/study/scene_subject.h"
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
    const std::unique_ptr<Subject> pendulum = makeProblem("pendulum");
    const Grid grid = pendulum->grid(2.0, 2.0);
    const Reference reference = makeReference(*pendulum, grid, grid.samples, 0.2);
    EXPECT_FALSE(reference.isExact);
    RunPlan plan;
    plan.method = "rk4";
    plan.grid = grid;
    const double start = pendulum->begin(plan)->observe().energy;
    // 1e-12 m in places on springs of 40 N/m that are stretched by a metre, and 1e-12 m/s at some m/s.
    for (const Observation& seen : reference.at) EXPECT_NEAR(seen.energy, start, 1e-9);
    EXPECT_TRUE(reference.isControlled);
    EXPECT_LT(reference.difference, 1e-9);
    EXPECT_DOUBLE_EQ(reference.error, 0.1 * reference.difference);
    EXPECT_DOUBLE_EQ(reference.floor, 100 * reference.error);
    EXPECT_EQ(methodOf(reference, "m"), "Fehlberg 7(8) at tolerances of 1e-10 and 1e-12 m/s");
}

// A subject of which theory is not told.
class Unsolved final : public Subject {
  public:
    explicit Unsolved(std::unique_ptr<Subject> subject) : subject_(std::move(subject)) {}
    const std::string& name() const override { return subject_->name(); }
    const std::string& title() const override { return subject_->title(); }
    int dimensions() const override { return subject_->dimensions(); }
    std::string unit() const override { return subject_->unit(); }
    bool hasEnergy() const override { return subject_->hasEnergy(); }
    double duration() const override { return subject_->duration(); }
    bool accepts(const ode::MethodInfo& method) const override { return subject_->accepts(method); }
    Grid grid(double duration, double window) const override { return subject_->grid(duration, window); }
    std::unique_ptr<Trial> begin(const RunPlan& plan) const override { return subject_->begin(plan); }
    double stepLimit(const ode::MethodInfo& method) const override { return subject_->stepLimit(method); }

  private:
    std::unique_ptr<Subject> subject_;
};

// RMS over all times.
double errorOf(const std::vector<Observation>& seen, const Subject& solved, const Grid& grid) {
    double sum = 0;
    for (int i = 0; i < grid.samples; ++i) {
        const double rms =
            rmsDifference(seen[i].values, solved.exact(grid.spacing * (i + 1))->values, solved.dimensions());
        sum += rms * rms;
    }
    return std::sqrt(sum / grid.samples);
}

// Loose tolerances, which an allowance of no time gives, stay clear of rounding.
TEST(StudyReference, ErrsLessThanItSaysAgainstTheory) {
    for (const char* name : {"chain", "net", "underdamped"}) {
        SCOPED_TRACE(name);
        const std::unique_ptr<Subject> solved = findProblem(name)->make();
        const Unsolved unsolved(findProblem(name)->make());
        const Grid grid = solved->grid(0.5, 0.5);
        const Reference reference = makeReference(unsolved, grid, grid.samples, 0.0);
        EXPECT_DOUBLE_EQ(reference.tolerance, 1e-9);
        const double error = errorOf(reference.at, *solved, grid);
        EXPECT_LT(error, reference.error);
        EXPECT_GT(error, 1e-4 * reference.error);  // and is of its size: the last two orders of ten are luck
    }
}

// The same of springs that are not linear, by Bulirsch and Stoer's method of Boost.odeint, on the pendulum's equation
// written here: x'' = -(k/m)(1 - L/|x|) x + g.
TEST(StudyReference, ErrsLessThanItSaysAgainstOdeint) {
    const std::unique_ptr<Subject> pendulum = makeProblem("pendulum");
    const Grid grid = pendulum->grid(2.0, 2.0);
    const Reference reference = makeReference(*pendulum, grid, grid.samples, 0.0);
    using State = std::array<double, 6>;
    const auto equation = [](const State& y, State& slope, double) {
        const double pull = 40.0 * (1.0 - 1.0 / std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]));
        slope = {y[3], y[4], y[5], -pull * y[0], -pull * y[1] - 9.81, -pull * y[2]};
    };
    State y{0.6, -1.0, 0.2, 0, 0, 0};
    double sum = 0;
    for (int i = 0; i < grid.samples; ++i) {
        boost::numeric::odeint::integrate_adaptive(boost::numeric::odeint::bulirsch_stoer<State>(1e-14, 1e-14),
                                                   equation, y, grid.spacing * i, grid.spacing * (i + 1), 1e-3);
        const double rms = rmsDifference(reference.at[i].values, std::span(y.data(), 3), 3);
        sum += rms * rms;
    }
    EXPECT_LT(std::sqrt(sum / grid.samples), reference.error);
}

// Between tolerances of 1e-8 and 1e-12 the error falls with the eighth power of the cost: 7.8 measured.
TEST(StudyReference, IsOfOrderEight) {
    const std::unique_ptr<Subject> chain = findProblem("chain")->make();
    RunPlan plan;
    plan.method = fehlberg78;
    plan.grid = chain->grid(0.5, 0.5);
    double errors[2], costs[2];
    for (std::size_t i = 0; i < 2; ++i) {
        plan.tolerance = i == 0 ? 1e-8 : 1e-12;
        const std::unique_ptr<Trial> trial = chain->begin(plan);
        std::vector<Observation> seen;
        for (int n = 0; n < plan.grid.samples; ++n) {
            ASSERT_TRUE(trial->advance());
            seen.push_back(trial->observe());
        }
        errors[i] = errorOf(seen, *chain, plan.grid);
        costs[i] = static_cast<double>(trial->work().evaluations);
    }
    const double order = std::log(errors[0] / errors[1]) / std::log(costs[1] / costs[0]);
    EXPECT_GT(order, 7.0);
    EXPECT_LT(order, 8.6);
}

// A net that falls on the ground: contact is of order 1, so the reference is one of many short steps, and says so.
TEST(StudyReference, OfContactsIsMadeInShortSteps) {
    world::SceneSpec scene;
    world::NetSpec net;
    net.name = "ball";
    net.points = {{"m", {0, 0.02, 0}, 1.0, false, {}}, {"n", {0, 0.12, 0}, 1.0, false, {}}};
    net.springs = {{"m", "n", 100.0, 0.1, {}, {}}};
    scene.bodies.add(net);
    world::ColliderSpec floor;
    floor.name = "floor";
    floor.shape = "plane";
    scene.colliders.push_back(floor);
    const std::unique_ptr<Subject> subject = makeSceneSubject(scene, "ball");
    const Grid grid = subject->grid(0.2, 0.2);
    const Reference reference = makeReference(*subject, grid, grid.samples, 0.01);
    EXPECT_FALSE(reference.isControlled);
    EXPECT_DOUBLE_EQ(reference.error, reference.difference);
    EXPECT_EQ(methodOf(reference, "m").substr(0, 13), "RK4 at steps ");
}

TEST(StudyReference, ErrorsThatItDoesNotResolveAreMarked) {
    const std::unique_ptr<Subject> pendulum = makeProblem("pendulum");
    StudySettings settings;
    settings.halvings = 9;
    settings.seconds = 1.0;
    settings.precisions = {Precision::double_};
    settings.methods = {"rk4", "leapfrog"};
    const WorkPrecision study = studyWorkPrecision(*pendulum, settings);
    for (const RunPoint& point : study.points) {
        if (point.status != RunStatus::ok) continue;
        EXPECT_EQ(point.isAtFloor, point.rmsError < 100 * study.reference.error);
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
    const std::unique_ptr<Subject> cloth = makeProblem("cloth-corners");
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
