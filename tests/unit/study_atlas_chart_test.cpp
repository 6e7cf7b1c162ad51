#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "taut/ode/method_table.h"
#include "taut/study/atlas_chart.h"

namespace taut::study {
namespace {

TEST(StabilityChart, NoTwoEntriesOfTheLegendLookTheSame) {
    StabilityMap map;
    map.columns = map.rows = 2;
    for (const ode::MethodInfo& method : ode::builtInMethods().all()) {
        StabilityPanel panel;
        panel.method = method.name;
        panel.title = method.title;
        panel.growth.assign(4, 1.0);
        panel.isWithoutLimit = !std::isfinite(predictedLimit(method, 0.5, panel.damping));
        map.panels.push_back(panel);
    }
    const report::Chart chart = stabilityChart(map, {});
    std::map<std::tuple<std::string, report::Mark, report::Dash, bool>, std::string> entries;
    for (const report::Panel& panel : chart.panels)
        for (const report::Curve& curve : panel.curves) {
            const report::Style& style = curve.style;
            const auto [known, isNew] =
                entries.try_emplace({style.colour, style.mark, style.dash, style.width > 0}, curve.title);
            EXPECT_EQ(known->second, curve.title);
        }
    EXPECT_GT(entries.size(), 5U);
}

}  // namespace
}  // namespace taut::study
