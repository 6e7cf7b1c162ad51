#include "taut/report/layout.h"

#include <gtest/gtest.h>

namespace taut::report {
namespace {

// rows × columns panels with all that takes room.
Chart fullChart(int panels, int columns) {
    Chart chart;
    chart.title = "title";
    chart.subtitle = "subtitle";
    chart.columns = columns;
    chart.panelWidth = 200;
    chart.panelHeight = 120;
    chart.notes = {"first", "second"};
    for (int i = 0; i < panels; ++i) {
        Panel panel;
        panel.title = "panel";
        panel.x.label = "x";
        panel.y.label = "y";
        panel.curves.push_back({"curve " + std::to_string(i), {}, {{1, 1}}});
        chart.panels.push_back(panel);
    }
    return chart;
}

TEST(ReportLayout, PanelsHaveTheirSizeAndDoNotOverlap) {
    const ChartLayout layout = layoutOf(fullChart(5, 3));
    ASSERT_EQ(layout.panels.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        const PanelBox& a = layout.panels[i];
        EXPECT_EQ(a.right - a.left, 200);
        EXPECT_EQ(a.top - a.bottom, 120);
        EXPECT_GT(a.left, 0);
        EXPECT_GT(a.bottom, 0);
        EXPECT_LT(a.right, layout.width);
        EXPECT_LT(a.top, layout.height);
        for (std::size_t j = i + 1; j < 5; ++j) {
            const PanelBox& b = layout.panels[j];
            EXPECT_TRUE(a.right <= b.left || b.right <= a.left || a.top <= b.bottom || b.top <= a.bottom);
        }
    }
    EXPECT_GT(layout.panels[0].bottom, layout.panels[3].top);  // read from the top left
    EXPECT_LT(layout.panels[0].right, layout.panels[1].left);
}

TEST(ReportLayout, TitlesLieAboveAndLegendAndNotesBelowThePanels) {
    const ChartLayout layout = layoutOf(fullChart(2, 2));
    EXPECT_GT(layout.title, layout.subtitle);
    EXPECT_GT(layout.subtitle, layout.panels[0].top);
    ASSERT_EQ(layout.legend.size(), 2U);
    ASSERT_EQ(layout.notes.size(), 2U);
    for (const LegendEntry& entry : layout.legend) {
        EXPECT_LT(entry.y, layout.panels[0].bottom);
        EXPECT_GT(entry.y, layout.notes[0]);
        EXPECT_LT(entry.x + sampleLength, layout.width);
    }
    EXPECT_GT(layout.notes[0], layout.notes[1]);
}

TEST(ReportLayout, CurvesOfOneTitleShareAnEntryOfTheLegend) {
    Chart chart = fullChart(2, 2);
    chart.panels[1].curves[0].title = chart.panels[0].curves[0].title;
    EXPECT_EQ(layoutOf(chart).legend.size(), 1U);
    chart.hasLegend = false;
    EXPECT_TRUE(layoutOf(chart).legend.empty());
}

}  // namespace
}  // namespace taut::report
