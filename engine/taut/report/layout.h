// Where the parts of a chart lie, in pixels of the picture from its lower left corner. It draws nothing.
#pragma once

#include <string>
#include <vector>

#include "taut/report/chart.h"

namespace taut::report {

struct PanelBox {
    double left = 0, right = 0, bottom = 0, top = 0;  // [px]
};

struct LegendEntry {
    std::string title;
    Style style;
    double x = 0, y = 0;  // [px] left end of the sample line, middle of its height
};

struct ChartLayout {
    double width = 0, height = 0;  // [px]
    std::vector<PanelBox> panels;  // plotting areas
    std::vector<LegendEntry> legend;
    double title = 0, subtitle = 0;  // [px] middle of the lines' heights
    double left = 0;                 // [px] where title and notes begin
    std::vector<double> notes;       // [px] middle of each line's height
    PanelBox colours;                // of the colour scale
};

inline constexpr double sampleLength = 34;  // [px] of a line in the legend

ChartLayout layoutOf(const Chart& chart);

}  // namespace taut::report
