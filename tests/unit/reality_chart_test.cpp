#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "taut/reality/chart.h"

namespace taut::reality {
namespace {

// Theory at Γ = 1 has H/W = 0.13.
TEST(DroopChart, DrawsOfEachProgramTheBestSettingsWithTheFinestStripsThatCameToRestAndNamesThem) {
    const std::vector<PeerDroop> peers = {
        {.peer = "Sheet", .gamma = 1, .cells = 5, .droop = 0.2, .isAtRest = true},
        {.peer = "Sheet", .gamma = 1, .cells = 10, .droop = 0.15, .isAtRest = true},
        {.peer = "Sheet", .gamma = 10, .cells = 10, .droop = 1.1, .isAtRest = false},
        {.peer = "Sheet as set", .gamma = 1, .cells = 10, .droop = 0.6, .isAtRest = true},
        {.peer = "Rag", .gamma = 1, .cells = 5, .droop = 30, .isAtRest = true},
    };
    const report::Chart chart = droopChart({}, peers, {});
    std::string drawn;
    for (const report::Curve& curve : chart.panels.at(0).curves) {
        drawn += curve.title + ":";
        for (const report::ChartPoint& point : curve.points)
            drawn += " " + std::to_string(point.x) + " " + std::to_string(point.y);
        drawn += "\n";
    }
    EXPECT_EQ(drawn, "Rag, 5 cells: 1.000000 30.000000\nSheet, 10 cells: 1.000000 0.150000\n");
    ASSERT_EQ(chart.panels.at(0).labels.size(), 2U);
    EXPECT_EQ(chart.panels.at(0).labels[1].text, "Sheet, 10 cells");
    EXPECT_FALSE(chart.hasLegend);
}

TEST(DroopChart, OfTautDrawsTheoryAndTheStripOfAsManyCellsAsOthersHave) {
    const std::vector<DroopCurve> curves = {{"elastica", false, 0, {{1.0, 0.13}}},
                                            {"10 cells", false, 10, {{1.0, 0.14}}},
                                            {"20 cells", false, 20, {{1.0, 0.132}}},
                                            {"bend springs", true, 20, {{1.0, 0.9}}}};
    const report::Chart chart = droopChart(curves, {}, {});
    ASSERT_EQ(chart.panels.at(0).curves.size(), 2U);
    EXPECT_EQ(chart.panels[0].curves[1].title, "20 cells");
}

}  // namespace
}  // namespace taut::reality
