// What `plan` picks, held against every resolution, method and step there is on three small scenes. The witness is a
// reference of its own: finer than plan's, by velocity Verlet instead of RK4, without plan's extrapolation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/small_scenes.h"
#include "taut/ode/method_table.h"
#include "taut/study/plan.h"
#include "taut/study/plan_run.h"
#include "taut/study/plan_search.h"
#include "taut/world/bodies/cloth.h"
#include "taut/world/bodies/net.h"
#include "taut/world/bodies/rope.h"
#include "taut/world/forces/wind.h"

namespace taut::study::plan_brute_force {
namespace {

world::SceneSpec shortScene(double seconds, double target) {
    world::SceneSpec scene;
    scene.file = "small.toml";
    scene.run.seconds = 1.0;
    scene.need.horizon = seconds;
    scene.need.rmsPosition = target;
    return scene;
}

// A rope that starts level and straight and swings down, held at one end.
world::SceneSpec swingingRope() {
    world::SceneSpec scene = shortScene(0.2, 4e-3);
    world::RopeSpec rope = support::rope("r", {0, 2, 0}, {1, 2, 0}, 16);
    rope.stretch = 60;
    rope.mass = 0.5;
    rope.dampingTime = 1e-3;
    rope.hold = {"start"};
    scene.bodies.add(rope);
    return scene;
}

// A cloth that falls from level, held along one edge.
world::SceneSpec fallingCloth() {
    world::SceneSpec scene = shortScene(0.2, 4e-3);
    scene.materials["m"].stretch = 30;
    scene.materials["m"].dampingTime = 1e-3;
    world::ClothSpec cloth = support::cloth("c", 8);
    cloth.down = {0, 0, 1};
    cloth.material = "m";
    cloth.hold = {"left"};
    scene.bodies.add(cloth);
    return scene;
}

// Two masses on springs of their own and one between: nothing to coarsen, the step decides.
world::SceneSpec smallNet() {
    world::SceneSpec scene = shortScene(0.5, 1e-3);
    world::NetSpec net;
    net.name = "n";
    net.drag = 0.5;
    net.points = {{"top", {0, 2, 0}, 1.0, true, {}},
                  {"a", {0.3, 1.5, 0}, 0.2, false, {}},
                  {"b", {0.6, 1.2, 0.1}, 0.1, false, {}}};
    net.springs = {{"top", "a", 120, 0.5, {}, {}}, {"a", "b", 60, 0.3, {}, {}}, {"top", "b", 20, 0.8, {}, {}}};
    scene.bodies.add(net);
    return scene;
}

struct Witness {
    PlanSettings settings;
    PlanContext context;
    PlanRun reference;

    // `count` cells, at a quarter of the stable step.
    Witness(const world::SceneSpec& spec, int count)
        : context{spec, settings, resolutionOf(spec), planGrid(spec, *spec.need.horizon), *spec.need.rmsPosition} {
        Candidate fine;
        fine.count = count;
        fine.method = "velocity-verlet";
        const StepFacts facts = stepFacts(modelOf(spec, context.resolution, fine));
        fine.substeps = std::max(4 * facts.leastSubsteps, 64);
        reference = play(sceneOf(context, fine), context.resolution, context.grid);
    }

    PlanRun runOf(const Candidate& candidate) const {
        return play(sceneOf(context, candidate), context.resolution, context.grid);
    }
    double errorOf(const Candidate& candidate) const { return difference(runOf(candidate), reference); }
};

// The smallest count of spring evaluations a frame with which any resolution, method and step meets the need. Methods
// that cost more than `most` are passed over.
double cheapest(const Witness& witness, const std::vector<Generator>& without, int mostCells, double most) {
    const double frames = witness.context.grid.frames();
    double best = most;
    const bool isFixed = witness.context.resolution.count == 0;
    for (int count = isFixed ? 0 : 2; count <= (isFixed ? 0 : mostCells); ++count)
        for (const ode::MethodInfo& method : ode::methods()) {
            Candidate candidate;
            candidate.count = count;
            candidate.without = without;
            candidate.method = std::string(method.name);
            const StepFacts facts = stepFacts(modelOf(witness.context.spec, witness.context.resolution, candidate));
            if (!facts.isPossible) continue;
            for (int substeps = facts.leastSubsteps;; ++substeps) {
                const double least = facts.cost * substeps * method.evaluations * witness.context.grid.ticks();
                if (least / frames >= best) break;
                candidate.substeps = substeps;
                const PlanRun run = witness.runOf(candidate);
                if (difference(run, witness.reference) <= witness.context.target)
                    best = std::min(best, run.cost / frames);
            }
        }
    return best;
}

struct Case {
    const char* name;
    world::SceneSpec (*scene)();
    int witnessCells;  // of the longest edge
};

class PlanAgainstBruteForce : public testing::TestWithParam<Case> {};

TEST_P(PlanAgainstBruteForce, MeetsTheNeedAtNearlyTheLowestCost) {
    const world::SceneSpec scene = GetParam().scene();
    const Plan plan = makePlan(scene);
    ASSERT_TRUE(plan.isMet());
    const PlanTrial& chosen = plan.trials[*plan.chosen];
    ASSERT_FALSE(chosen.isAsWritten);

    const Witness witness(scene, GetParam().witnessCells);
    EXPECT_LE(witness.errorOf(chosen.candidate), *scene.need.rmsPosition);

    // 1.25: the search stops at 4 % more steps than needed, counts the reference's own error against itself, and a
    // resolution more or less of a dozen cells changes the cost by a fifth.
    const double best = cheapest(witness, chosen.candidate.without, chosen.candidate.count + 2, 2 * chosen.cost);
    EXPECT_LE(chosen.cost, 1.25 * best);
    RecordProperty("cost_over_best", std::to_string(chosen.cost / best));
}

INSTANTIATE_TEST_SUITE_P(Scenes, PlanAgainstBruteForce,
                         testing::Values(Case{"Rope", swingingRope, 96}, Case{"Cloth", fallingCloth, 40},
                                         Case{"Net", smallNet, 0}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(Plan, IsTheSameEveryTime) {
    const world::SceneSpec scene = swingingRope();
    const Plan one = makePlan(scene), two = makePlan(scene);
    ASSERT_TRUE(one.chosen && two.chosen);
    EXPECT_EQ(*one.chosen, *two.chosen);
    EXPECT_EQ(one.trials[*one.chosen].error, two.trials[*two.chosen].error);
    EXPECT_EQ(one.trials[*one.chosen].cost, two.trials[*two.chosen].cost);
}

TEST(Plan, SaysHowNearItComesWhenNothingMeetsTheNeed) {
    world::SceneSpec scene = swingingRope();
    scene.need.rmsPosition = 1e-7;  // of a rope of at most 8 times 16 segments, which is known to micrometres
    PlanSettings settings;
    settings.effort = 1e6;
    const Plan plan = makePlan(scene, settings);
    EXPECT_FALSE(plan.isMet());
    EXPECT_FALSE(plan.chosen.has_value());
    ASSERT_FALSE(plan.trials.empty());
    EXPECT_GT(plan.trials.back().error, 1e-7);
}

TEST(Plan, ABudgetThatIsTooSmallIsNotMet) {
    world::SceneSpec scene = smallNet();
    scene.need.budget = 1e-9;  // [ms] less than one instruction
    const Plan plan = makePlan(scene);
    EXPECT_TRUE(plan.isAccurate());
    EXPECT_FALSE(plan.isMet());
}

TEST(Plan, LeavesOutAForceWithoutEffectAndKeepsOneThatMatters) {
    world::SceneSpec scene = fallingCloth();
    scene.materials["m"].drag = 1e-6;  // moves the cloth by 1e-6 of its way, 0.2 µm
    scene.forces.add(world::WindSpec{});
    scene.forces.of<world::WindSpec>().back().name = "storm";
    scene.forces.of<world::WindSpec>().back().velocity = {20, 0, 0};
    PlanSettings settings;
    settings.effort = 2e6;
    const Plan plan = makePlan(scene, settings);
    const auto find = [&](const std::string& name) {
        return std::find_if(plan.generators.begin(), plan.generators.end(),
                            [&](const GeneratorTrial& trial) { return trial.name == name; });
    };
    ASSERT_NE(find("drag"), plan.generators.end());
    ASSERT_NE(find("wind storm"), plan.generators.end());
    EXPECT_TRUE(find("drag")->isLeftOut);
    EXPECT_FALSE(find("wind storm")->isLeftOut);
    EXPECT_GT(find("wind storm")->change, 1e-3);
}

// A straight rope pushed together buckles: a shift of a micrometre grows a thousandfold at once.
world::SceneSpec bucklingRope(double target) {
    world::SceneSpec scene = shortScene(0.5, target);
    scene.world.gravity = {0, 0, 0};
    world::RopeSpec rope = support::rope("r", {0, 2, 0}, {0.1, 2, 0}, 8);
    rope.stretch = 500;
    rope.mass = 0.05;
    rope.velocity = {-5, 0, 0};
    rope.hold = {"start"};
    scene.bodies.add(rope);
    return scene;
}

TEST(Plan, OfAChaoticSceneItPromisesNoMoreThanTheHorizonAndDoesNotMeetTheNeed) {
    const Plan plan = makePlan(bucklingRope(1e-3));
    EXPECT_TRUE(plan.isChaotic);
    EXPECT_LT(plan.seconds, 0.5);
    EXPECT_FALSE(plan.isMet());
    EXPECT_TRUE(std::any_of(plan.remarks.begin(), plan.remarks.end(),
                            [](const std::string& remark) { return remark.find("chaotic") != std::string::npos; }));
}

TEST(Plan, CallsNothingChaoticThatStaysWithinTheTarget) {
    // The same rope: whichever way it buckles, points of a rope of 0.1 m are hardly further apart than that.
    PlanSettings settings;
    settings.effort = 1e6;
    const Plan plan = makePlan(bucklingRope(0.3), settings);
    EXPECT_FALSE(plan.isChaotic);
    EXPECT_DOUBLE_EQ(plan.seconds, 0.5);
    EXPECT_DOUBLE_EQ(plan.unseen(), 0.5) << "of a run of one second";
}

}  // namespace
}  // namespace taut::study::plan_brute_force
