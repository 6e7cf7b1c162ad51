#include "taut/study/contact_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "game/chart_studies.h"
#include "image_support.h"
#include "program_support.h"

namespace taut::study {
namespace {

// A block of sixteen steps counts a gap as closed through which the ball would fall from rest in it. The bounce has to
// begin there, too, or the impulses of the first step stop the ball: 99 % of the energy went so.
TEST(ContactStudy, ABallBouncesWithFewDetectionsToo) {
    const ContactStudy study = studyContact({.problems = {"ball-bounces"}, .steps = {16}});
    ASSERT_EQ(study.runs.size(), 7U);
    for (const ContactRun& run : study.runs) EXPECT_LT(std::abs(run.error), 0.004) << run.detections;
}

// One detection a tick is enough for a ball that rolls and a box that slides, and for the guarantee of sheets: of the
// fifth by which they may overlap they use a tenth.
TEST(ContactStudy, FewDetectionsCostLittleAccuracy) {
    const ContactStudy study =
        studyContact({.problems = {"ball-rolls", "box-slides", "sheet-falls"}, .steps = {1}, .detections = {1, 4}});
    ASSERT_EQ(study.runs.size(), 6U);
    for (const ContactRun& run : study.runs) {
        EXPECT_TRUE(run.hasEnded) << run.problem;
        EXPECT_LT(std::abs(run.error), run.problem == "sheet-falls" ? 0.02 : 1e-6) << run.problem;
        EXPECT_EQ(run.crossings, 0) << run.problem;
    }
}

TEST(ContactStudy, IsWrittenAsTablesAndPictures) {
    const test::TemporaryFolder folder;
    testing::internal::CaptureStdout();
    const int code = game::chartContact(folder / "out", "a note", true,
                                        {.problems = {"box-slides"}, .steps = {1, 4}, .detections = {1, 8}});
    const std::string table = testing::internal::GetCapturedStdout();
    EXPECT_EQ(code, 0);
    EXPECT_NE(table.find("box-slides"), std::string::npos) << table;
    const std::string csv = test::contentOf(folder / "out/contact.csv");
    EXPECT_EQ(csv.substr(0, 24), "problem,steps,detections");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3);  // no more detections than steps
    for (const char* name : {"contact-detections.png", "contact-detections.svg"})
        EXPECT_GT(std::filesystem::file_size(folder / "out" / name), 0U) << name;
}

}  // namespace
}  // namespace taut::study
