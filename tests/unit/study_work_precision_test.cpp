#include "taut/spec/spec.h"
#include "taut/study/work_precision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "taut/bodies/net.h"
#include "taut/core/error.h"
#include "taut/ode/method_table.h"
#include "taut/study/problems.h"
#include "taut/study/scene_subject.h"
#include "taut/study/work_precision_chart.h"
#include "taut/study/work_precision_text.h"

namespace taut::study {
namespace {

StudySettings fixed(int halvings, std::vector<Precision> precisions = {Precision::double_}) {
    StudySettings settings;
    settings.halvings = halvings;
    settings.precisions = std::move(precisions);
    return settings;
}

const WorkPrecision& oscillatorStudy() {
    static const WorkPrecision study = studyWorkPrecision(*makeProblem("oscillator"), fixed(5));
    return study;
}

// A mass of 1 kg on a spring of 1e5 N/m (ω = 316 /s, of which leap-frog stands steps of 6.3 ms) that hangs over a
// plane.
world::SceneSpec hangingOver(double plane) {
    world::SceneSpec scene;
    scene.run = {30.0, 0.5};
    world::NetSpec net;
    net.name = "spring";
    net.drag = 0.0;
    net.points = {{"nail", {0, 2, 0}, 1.0, true, {}}, {"bob", {0, 1, 0}, 1.0, false, {}}};
    net.springs = {{"nail", "bob", 1e5, 1.0, std::nullopt, {}}};
    scene.bodies.add(net);
    world::ColliderSpec ground;
    ground.name = "ground";
    ground.shape = "plane";
    ground.position = {0, plane, 0};
    ground.restitution = 1.0;
    scene.colliders = {ground};
    return scene;
}

TEST(StudyWorkPrecision, RunsThatDivergeIntoAColliderMakeNoContacts) {
    StudySettings settings = fixed(4);
    settings.methods = {"leapfrog", "rk4"};
    const WorkPrecision study = studyWorkPrecision(*makeSceneSubject(hangingOver(0.95), "s"), settings);
    EXPECT_TRUE(std::any_of(study.points.begin(), study.points.end(),
                            [](const RunPoint& point) { return point.status != RunStatus::ok; }));
    EXPECT_FALSE(study.hasContacts);
    for (const std::string& remark : study.remarks) EXPECT_EQ(remark.find("contacts"), std::string::npos) << remark;
}

TEST(StudyWorkPrecision, ContactsBetweenTheMomentsThatAreLookedAtCount) {
    world::SceneSpec scene = hangingOver(0.95);
    auto& net = scene.bodies.of<world::NetSpec>()[0];
    net.springs[0].stiffness = 0.1;  // it falls 0.05 m in 0.1 s, and is back 0.1 s later
    net.thickness = 0.0;
    const auto subject = makeSceneSubject(scene, "s");
    RunPlan plan{"leapfrog", Precision::double_, {0.2, 1}, 0, 0};
    plan.stepsPerSample = stepsPerSample(*subject, plan.grid, 1e-3);
    const auto trial = subject->begin(plan);
    ASSERT_TRUE(trial->advance());
    const Observation seen = trial->observe();
    EXPECT_GT(seen.values[1], 0.99);  // in the air again
    EXPECT_TRUE(seen.hasTouched);
}

TEST(StudyWorkPrecision, AFrameIsThatOfTheScene) {
    const WorkPrecision study = studyWorkPrecision(*makeSceneSubject(hangingOver(0.0), "s"), fixed(2));
    EXPECT_EQ(study.frame, 1.0 / 30);
    EXPECT_EQ(oscillatorStudy().frame, 1.0 / 60);
    WorkPrecision slow = oscillatorStudy();
    slow.frame = 0.1;
    std::string labels;
    for (const NamedChart& chart : workPrecisionCharts(slow, {}))
        for (const report::Panel& panel : chart.chart.panels) {
            for (const report::Guide& guide : panel.guides) labels += guide.label + "|";
            for (const report::Label& label : panel.labels) labels += label.text + "|";
        }
    EXPECT_EQ(labels.find("1/60 s"), std::string::npos) << labels;
    EXPECT_NE(labels.find("a frame, 1/10 s"), std::string::npos) << labels;
}

TEST(StudyWorkPrecision, EveryMethodOfTheTableAppears) {
    const WorkPrecision& study = oscillatorStudy();
    ASSERT_EQ(study.methods.size(), ode::methods().size());
    for (const ode::MethodInfo& method : ode::methods())
        EXPECT_EQ(std::count_if(study.points.begin(), study.points.end(),
                                [&](const RunPoint& point) { return point.method == method.name; }),
                  6)
            << method.name;
}

// The solves of an implicit method get finer with the step: with a fixed tolerance the error stays at 1e-6 m.
TEST(StudyWorkPrecision, SolvesSetNoFloor) {
    StudySettings settings = fixed(8);
    settings.methods = {"sdirk2"};
    const WorkPrecision study = studyWorkPrecision(*makeProblem("cloth-corners"), settings);
    EXPECT_NEAR(measuredOrder(study, "sdirk2", Precision::double_), 2.0, 0.1);
}

// In single precision velocity Verlet comes down to rounding, some 1e-7 of the amplitude; in double it does not here.
TEST(StudyWorkPrecision, AFloorOfRoundingIsMarkedAndTheOrderIsOfWhatLiesAbove) {
    StudySettings settings = fixed(12, {Precision::single_, Precision::double_});
    settings.methods = {"velocity-verlet"};
    const WorkPrecision study = studyWorkPrecision(*makeProblem("oscillator"), settings);
    bool isBelow = false;
    for (const RunPoint& point : study.points) {
        if (point.precision == Precision::double_) {
            EXPECT_FALSE(point.isAtFloor) << point.step;
            continue;
        }
        EXPECT_TRUE(point.isAtFloor || !isBelow) << point.step;  // from the first on
        isBelow = point.isAtFloor;
    }
    EXPECT_TRUE(isBelow);
    for (const Precision precision : {Precision::single_, Precision::double_})
        EXPECT_NEAR(measuredOrder(study, "velocity-verlet", precision), 2.0, 0.1);
    for (const NamedChart& drawn : workPrecisionCharts(study, {}))
        if (drawn.name != "energy") EXPECT_NE(drawn.chart.notes.front().find("White dot"), std::string::npos);
}

TEST(StudyWorkPrecision, AnEquationOfFirstOrderTakesTheMethodsThatCan) {
    const WorkPrecision study = studyWorkPrecision(*makeProblem("growth"), fixed(2));
    for (const MethodFacts& method : study.methods) EXPECT_TRUE(ode::findMethod(method.name)->isFirstOrder());
    EXPECT_GE(study.methods.size(), 1U);
    StudySettings settings = fixed(2);
    settings.methods = {"leapfrog"};
    EXPECT_THROW(studyWorkPrecision(*makeProblem("growth"), settings), core::Error);
    settings.methods = {"no such"};
    EXPECT_THROW(studyWorkPrecision(*makeProblem("growth"), settings), core::Error);
}

// Heun and RK4 integrate y' + y/x = -4 from y = 3/x - 2x exactly, Euler does not.
TEST(StudyWorkPrecision, HeunAndRungeKuttaSolveTheQuotientToRounding) {
    const WorkPrecision study = studyWorkPrecision(*makeProblem("quotient"), fixed(3));
    for (const RunPoint& point : study.points) {
        if (point.method == "heun" || point.method == "rk4")
            EXPECT_LT(point.rmsError, 1e-14) << point.method;  // some 80 roundings of numbers below 4
        if (point.method == "euler") EXPECT_GT(point.rmsError, 1e-4);
    }
}

// Steps over the limit diverge, and steps within it do not; a run within a tenth of the limit is left out, because the
// ten samples of five seconds do not see slow growth.
TEST(StudyWorkPrecision, RunsFailBeyondTheLimitAndStayInTheTable) {
    const WorkPrecision& study = oscillatorStudy();
    int failed = 0;
    for (const RunPoint& point : study.points) {
        const auto method = std::find_if(study.methods.begin(), study.methods.end(),
                                         [&](const MethodFacts& facts) { return facts.name == point.method; });
        if (method->stepLimit == 0) continue;
        if (point.step < 0.9 * method->stepLimit)
            EXPECT_EQ(point.status, RunStatus::ok) << point.method << " at " << point.step;
        if (point.step > 1.1 * method->stepLimit) {
            EXPECT_NE(point.status, RunStatus::ok) << point.method << " at " << point.step;
            ++failed;
        }
    }
    EXPECT_GE(failed, 3);
    const std::string csv = workPrecisionCsv(study);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<std::ptrdiff_t>(study.points.size()) + 1);
    std::istringstream lines(csv);
    int rows = 0;
    for (std::string line; std::getline(lines, line);)
        rows += line.find(",diverged,") != std::string::npos || line.find(",lost,") != std::string::npos ? 1 : 0;
    EXPECT_GE(rows, failed);
}

TEST(StudyWorkPrecision, CountsWhatAMethodEvaluates) {
    for (const RunPoint& point : oscillatorStudy().points) {
        const ode::MethodInfo& method = *ode::findMethod(point.method);
        if (point.status != RunStatus::ok || point.iterations > 0 || method.evaluations == 0) continue;
        const long long perStep = method.evaluations;
        // One more to start, at most.
        EXPECT_GE(point.evaluations, perStep * point.steps) << point.method;
        EXPECT_LE(point.evaluations, perStep * point.steps + 1) << point.method;
    }
}

TEST(StudyWorkPrecision, FailedRunsAreMarkedInEveryChart) {
    const WorkPrecision& study = oscillatorStudy();
    const auto failed = static_cast<std::size_t>(std::count_if(
        study.points.begin(), study.points.end(), [](const RunPoint& p) { return p.status != RunStatus::ok; }));
    const std::vector<NamedChart> charts = workPrecisionCharts(study, {"machine"});
    ASSERT_EQ(charts.size(), 3U);
    EXPECT_EQ(charts[0].name, "time");
    EXPECT_EQ(charts[1].name, "evaluations");
    EXPECT_EQ(charts[2].name, "energy");
    for (const NamedChart& drawn : charts) {
        ASSERT_EQ(drawn.chart.panels.size(), 1U);  // one precision
        const auto& marks = drawn.chart.panels[0].strip.marks;
        const auto shown = static_cast<std::size_t>(std::count_if(
            marks.begin(), marks.end(), [](const auto& mark) { return mark.style.mark != report::Mark::bar; }));
        EXPECT_EQ(shown, failed) << drawn.name;
        EXPECT_EQ(drawn.chart.notes.back(), "machine");
    }
}

TEST(StudyWorkPrecision, JsonHoldsTheMachineAndEveryRun) {
    const WorkPrecision& study = oscillatorStudy();
    const auto json = nlohmann::json::parse(
        workPrecisionJson(study, stepsTable(*makeProblem("growth"), 1e-2), {{"processor", "a \"fast\" one"}}));
    EXPECT_EQ(json["machine"]["processor"], "a \"fast\" one");
    EXPECT_EQ(json["runs"].size(), study.points.size());
    EXPECT_EQ(json["reference"]["kind"], "exact");
    EXPECT_EQ(json["steps_table"].size(), 4U);
    EXPECT_TRUE(json["methods"].back().contains("measured_order_double"));
}

TEST(StudyWorkPrecision, StopsWhenAsked) {
    const std::atomic<bool> stop(true);
    StudySettings settings = fixed(3);
    settings.listener.stop = &stop;
    const WorkPrecision study = studyWorkPrecision(*makeProblem("growth"), settings);
    EXPECT_TRUE(study.isInterrupted);
    EXPECT_TRUE(study.points.empty());
    EXPECT_FALSE(study.remarks.empty());
    EXPECT_EQ(workPrecisionCharts(study, {}).size(), 2U);  // nothing to draw is no reason to fail
}

}  // namespace
}  // namespace taut::study
