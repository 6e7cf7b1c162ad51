#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "taut/reality/chart.h"

namespace taut::reality {
namespace {

TEST(DroopChart, DrawsTheFinestStripsOfEachProgramThatCameToRest) {
    const std::vector<PeerDroop> peers = {
        {.peer = "Sheet", .gamma = 1, .cells = 5, .droop = 0.2, .isAtRest = true},
        {.peer = "Sheet", .gamma = 1, .cells = 10, .droop = 0.15, .isAtRest = true},
        {.peer = "Sheet", .gamma = 10, .cells = 10, .droop = 1.1, .isAtRest = false},
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
    EXPECT_EQ(drawn, "Sheet, 10 cells: 1.000000 0.150000\nRag, 5 cells: 1.000000 30.000000\n");
}

}  // namespace
}  // namespace taut::reality
