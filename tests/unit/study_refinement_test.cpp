#include "taut/study/refinement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "game/chart_studies.h"
#include "image_support.h"
#include "program_support.h"
#include "taut/study/refinement_chart.h"
#include "taut/study/refinement_text.h"
#include "taut/study/statics.h"

namespace taut::study {
namespace {

using glm::dvec3;

double errorAt(const RefinementStudy& study, const std::string& body, const std::string& treatment, int cells) {
    for (const RefinementRun& run : study.runs)
        if (run.body == body && run.treatment == treatment && run.cells == cells) {
            EXPECT_TRUE(run.isAtRest) << body << ", " << treatment << ", " << cells;
            return run.error;
        }
    ADD_FAILURE() << "no " << body << ", " << treatment << ", " << cells;
    return 0.0;
}

TEST(Equilibrium, OfAMassOnASpringIsItsWeightOverTheStiffness) {
    mechanics::Model model;
    model.positions = {{0, 0, 0}, {0, -1, 0}};
    model.velocities.assign(2, dvec3(0.0));
    model.masses = {1.0, 0.2};
    model.dragRates.assign(2, 0.0);
    model.held = {true, false};
    model.springs = {{0, 1, 50.0, 1.0, 0.0, mechanics::SpringKind::structural}};
    const Equilibrium rest = equilibrium(model, {0, -9.81, 0});
    EXPECT_TRUE(rest.isAtRest);
    EXPECT_EQ(rest.positions[0], dvec3(0.0));
    EXPECT_NEAR(rest.positions[1].y, -1.0 - 0.2 * 9.81 / 50.0, 1e-9);  // Newton's last step: rounding and 1e-6 squared
    EXPECT_LT(rest.residual, 1e-8);
}

// In free fall there is none.
TEST(Equilibrium, IsNotClaimedWhereThereIsNone) {
    mechanics::Model model;
    model.positions = {{0, 0, 0}};
    model.velocities.assign(1, dvec3(0.0));
    model.masses = {1.0};
    model.dragRates = {0.0};
    model.held = {false};
    const Equilibrium rest = equilibrium(model, {0, -9.81, 0});
    EXPECT_FALSE(rest.isAtRest);
    EXPECT_NEAR(rest.residual, 1.0, 1e-12);
}

// A chain of n links is off the smooth curve by 1/n², ends that weigh too much add 1/n. Hung by one end, half a link's
// mass at either end or M/(n + 1) everywhere come to the same: Σ (n - i + 1) M/(n + 1) = M n/2.
TEST(Refinement, OfRopesIsOfSecondOrderWeightedAndOfFirstWithNaiveMass) {
    const RefinementStudy study = studyRefinement({.bodies = {"rope-catenary", "rope-taut", "rope-hanging"}});
    for (const char* body : {"rope-catenary", "rope-taut"}) {
        EXPECT_NEAR(measuredOrder(study, body, "weighted"), 2.0, 0.05) << body;  // n = 32: the next term is 1/n² of it
        EXPECT_LT(std::abs(errorAt(study, body, "weighted", 32)), 1e-3) << body;
    }
    EXPECT_NEAR(measuredOrder(study, "rope-taut", "naive-mass"), 1.0, 0.1);
    // Of the mass 1/(n + 1) is lost to either held end instead of half a link's: (n - 1)/(n + 1) against (n - 1)/n.
    EXPECT_NEAR(errorAt(study, "rope-taut", "naive-mass", 32), -1.0 / 33, 3e-3);
    for (const char* treatment : {"weighted", "naive-mass"})
        for (const int n : {4, 8, 16, 32}) EXPECT_LT(std::abs(errorAt(study, "rope-hanging", treatment, n)), 1e-8);
    EXPECT_TRUE(std::isnan(measuredOrder(study, "rope-hanging", "weighted")));
}

// Springs and masses that the edge shares make the net a scheme of second order for the elastic continuum; full ones
// are of first, and 1 + 1/n too stiff or 1/n too heavy at the edge.
TEST(Refinement, OfClothsAndBlocksIsOfSecondOrderWeightedAndOfFirstElse) {
    const RefinementStudy cloths = studyRefinement({.bodies = {"cloth-membrane", "cloth-strip"}});
    EXPECT_NEAR(measuredOrder(cloths, "cloth-membrane", "weighted"), 2.0, 0.05);
    EXPECT_NEAR(measuredOrder(cloths, "cloth-strip", "weighted"), 2.0, 0.1);  // corners come in late
    EXPECT_LT(std::abs(errorAt(cloths, "cloth-strip", "weighted", 4)), 2e-3);
    EXPECT_NEAR(measuredOrder(cloths, "cloth-membrane", "naive-mass"), 1.0, 0.1);
    for (const char* treatment : {"naive-mass", "naive-springs", "naive"})
        EXPECT_NEAR(measuredOrder(cloths, "cloth-strip", treatment), 1.0, 0.1) << treatment;
    // Each point of 33² weighs M/33², should M/32².
    EXPECT_NEAR(errorAt(cloths, "cloth-membrane", "naive-mass", 32), std::pow(32.0 / 33, 2) - 1.0, 2e-3);

    // Up to 16 cells: 0.3 % weighted, 15 % not. The masses have the inertia of the block, which costs statics 4/n²:
    // with plain shares of cells it would be 0.03 %.
    const RefinementStudy block = studyRefinement({.bodies = {"block-column"}, .cells = {4, 8, 16}});
    EXPECT_LT(std::abs(errorAt(block, "block-column", "weighted", 16)), 4e-3);
    EXPECT_GT(measuredOrder(block, "block-column", "weighted"), 1.5);
    EXPECT_LT(errorAt(block, "block-column", "naive", 16), -0.1);
    EXPECT_NEAR(measuredOrder(block, "block-column", "naive"), 0.9, 0.15);
}

// The drape within 1 %: with order 2 (the loose cloth) or 1.4 (the curtain, whose held corners are singular) 16 cells
// do; without the weights 32 do not.
TEST(Refinement, KeepsTheDrapeOfAClothWithinOnePerCent) {
    const RefinementStudy study = studyRefinement({.bodies = {"cloth-drape", "cloth-curtain"}});
    EXPECT_NEAR(measuredOrder(study, "cloth-drape", "weighted"), 2.0, 0.1);
    EXPECT_NEAR(measuredOrder(study, "cloth-curtain", "weighted"), 1.4, 0.1);
    for (const char* body : {"cloth-drape", "cloth-curtain"})
        for (const int n : {16, 32}) {
            EXPECT_LT(std::abs(errorAt(study, body, "weighted", n)), 0.01) << body;
            EXPECT_GT(std::abs(errorAt(study, body, "naive", n)), 0.01) << body;
        }
}

TEST(Refinement, OfABeamComesToRestAndConverges) {
    const RefinementStudy study = studyRefinement({.bodies = {"block-beam"}, .cells = {4, 8, 16}});
    // Its held edge is singular: order 1.6, and 3.0 % as measured.
    EXPECT_LT(std::abs(errorAt(study, "block-beam", "weighted", 16)), 0.04);
    EXPECT_GT(std::abs(errorAt(study, "block-beam", "naive", 16)), 0.15);
}

TEST(Refinement, StopsWhenAskedAndTellsItsProgress) {
    std::atomic<bool> stop = false;
    double last = -1.0;
    RefinementSettings settings{.bodies = {"rope-taut", "rope-hanging"}, .listener = {.stop = &stop}};
    settings.listener.progress = [&](double done, const std::string& doing) {
        EXPECT_GE(done, last);
        last = done;
        if (doing.starts_with("rope-hanging")) stop = true;
    };
    const RefinementStudy study = studyRefinement(settings);
    EXPECT_TRUE(study.isInterrupted);
    ASSERT_EQ(study.bodies.size(), 1U);  // whole bodies only
    EXPECT_EQ(study.runs.size(), 8U);    // two treatments, four resolutions
}

TEST(Refinement, IsWrittenAsTablesAndPictures) {
    const test::TemporaryFolder folder;
    testing::internal::CaptureStdout();
    const int code = game::chartRefinement(folder / "out", "a note", true, {.bodies = {"rope-taut"}});
    const std::string table = testing::internal::GetCapturedStdout();
    EXPECT_EQ(code, 0);
    EXPECT_NE(table.find("+0.2440"), std::string::npos) << table;  // per cent at 4 links, as in the first test
    EXPECT_NE(table.find("2.00"), std::string::npos) << table;
    const std::string csv = test::contentOf(folder / "out/refinement.csv");
    EXPECT_EQ(csv.substr(0, 23), "body,quantity,treatment");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 8);
    EXPECT_GT(std::filesystem::file_size(folder / "out/refinement-error.svg"), 0U);
    EXPECT_GT(std::filesystem::file_size(folder / "out/refinement-error.png"), 0U);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/refinement-drape.svg"));  // no body of that kind
}

TEST(Refinement, IsListedAndTakesNoFlagsOfMotion) {
    EXPECT_TRUE(test::has(test::run({"chart", "--list"}).out, "refinement"));
    for (const char* flag : {"--methods=rk4", "--precision=single", "--seconds=1", "--budget=1", "--set=run.fps=30"}) {
        const test::Outcome outcome = test::run({"chart", "refinement", flag});
        EXPECT_EQ(outcome.code, 2) << flag;
        EXPECT_TRUE(test::has(outcome.err, "bodies at rest")) << outcome.err;
    }
    const test::Outcome near = test::run({"chart", "refinment"});
    EXPECT_EQ(near.code, 2);
    EXPECT_TRUE(test::has(near.err, "did you mean refinement?")) << near.err;
}

}  // namespace
}  // namespace taut::study
