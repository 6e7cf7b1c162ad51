#include "taut/report/gnuplot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>

#include "image_support.h"
#include "support/text.h"
#include "taut/core/error.h"
#include "taut/image/read.h"
#include "taut/report/layout.h"
#include "taut/report/palette.h"

namespace taut::report {
namespace {

using test::has;
using test::TemporaryFolder;

// Something of everything that a chart can hold.
Chart fullChart() {
    Chart chart;
    chart.title = "It's `date` \"all\" $HOME @x {y}_z^2 \\ \n over";
    chart.pngScale = 1.0;
    chart.panelWidth = 220;
    chart.panelHeight = 160;
    chart.colours = divergingScale(0.0, 1.0, 2.0);
    Panel curves;
    curves.x = {"h [s]", Scale::log, 1e-3, 1.0};
    curves.y = {"error", Scale::log, 1e-6, 1.0};
    curves.curves.push_back(
        {"leapfrog", styleOf("leapfrog"), {{1e-2, 1e-4, 9e-3, 2e-2}, {1e-1, 1e-2, nothing, nothing, 1e-3, 2e-2}}});
    curves.curves.push_back({"midpoint", styleOf("midpoint"), {{1e-2, 1e-3}, {std::nan(""), 1.0}, {1e-1, 1e-1}}});
    curves.strip = {"failed", 2, {{0.5, 0, styleOf("leapfrog")}, {0.3, 1, {"#ff0000", Mark::bar}}}};
    curves.regions.push_back({0.2, {}, {}, 0.1});
    Guide guide;
    guide.x = 0.2;
    guide.label = "limit";
    curves.guides.push_back(guide);
    curves.labels.push_back({0.01, 0.01, "here", "#303030", Align::centre, 2, 3, 11, true});
    Panel map;
    map.x = {"a", Scale::linear, 0.0, 1.0};
    map.y = {"b", Scale::linear, 0.0, 1.0};
    map.map = HeatMap{2, 2, 0.25, 0.75, 0.25, 0.75, {0.1, 0.9, 1.8, std::nan("")}};
    map.arrows.push_back({{{0.2, 0.2, 0.1, 0.1}}});
    chart.panels = {curves, map};
    return chart;
}

TEST(ReportGnuplot, WritesPerCentAtATick) {
    const TemporaryFolder folder;
    Chart chart;
    Panel panel;
    panel.y = {"error", Scale::log, 1e-3, 1.0, {{0.01, "1 %"}, {0.1, "10 %d"}}};
    panel.curves.push_back({"a", {}, {{0.0, 0.1}, {1.0, 0.2}}});
    chart.panels = {panel};
    writeChart(chart, folder / "chart");
    const std::string svg = test::contentOf(folder / "chart.svg");
    EXPECT_TRUE(has(svg, "1 %<"));
    EXPECT_TRUE(has(svg, "10 %d<"));
}

// A failed run has no error: beside the strip, which takes some two of six decades here, stand no powers of ten.
TEST(ReportGnuplot, AStripOfFailuresHasNoNumbers) {
    Chart chart;
    chart.panelHeight = 160;
    Panel panel;
    panel.x = {"h [s]", Scale::log, 1e-3, 1.0};
    panel.y = {"error", Scale::log, 1e-6, 1.0};
    Guide guide;
    guide.x = 0.1;
    panel.guides.push_back(guide);
    chart.panels = {panel};
    const std::string without = gnuplotScript(chart, Format::svg);
    EXPECT_TRUE(has(without, "from first 0.1, graph 0 to first 0.1, graph 1 "));
    chart.panels[0].strip = {"failed", 4, {}};
    const std::string with = gnuplotScript(chart, Format::svg);
    for (const int power : {-6, -3, -2}) EXPECT_TRUE(has(with, "\"10^{" + std::to_string(power) + "}\"")) << power;
    for (const int power : {-1, 0}) EXPECT_FALSE(has(with, "\"10^{" + std::to_string(power) + "}\"")) << power;
    // Four rows of 11 px and 6 px: 50 of 160.
    EXPECT_TRUE(has(with, "from first 0.1, graph 0 to first 0.1, graph 0.6875 "));
}

TEST(ReportGnuplot, DrawsEverythingAChartCanHold) {
    const TemporaryFolder folder;
    const Chart chart = fullChart();
    writeChart(chart, folder / "chart");
    const image::Image picture = image::readImage(folder / "chart.png");
    const ChartLayout layout = layoutOf(chart);
    EXPECT_EQ(picture.width, std::lround(layout.width));
    EXPECT_EQ(picture.height, std::lround(layout.height));
    const std::string svg = test::contentOf(folder / "chart.svg");
    EXPECT_TRUE(has(svg, "<svg"));
    EXPECT_TRUE(svg.ends_with("</svg>\n") || has(svg.substr(svg.size() - 20), "</svg>"));
    // Whole or not at all: nothing is left of the names they had while being written.
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

// The colour of a heat map's cell stands where the layout says: the first row at the foot.
TEST(ReportGnuplot, AMapLiesWhereItsAxesSay) {
    const TemporaryFolder folder;
    const Chart chart = fullChart();
    writeChart(chart, folder / "chart");
    const image::Image picture = image::readImage(folder / "chart.png");
    const PanelBox box = layoutOf(chart).panels[1];
    const auto redMinusBlue = [&](double u, double v) {
        const auto x = static_cast<std::size_t>(box.left + u * (box.right - box.left));
        const auto y = static_cast<std::size_t>(picture.height - (box.bottom + v * (box.top - box.bottom)));
        const std::size_t at = 3 * (y * static_cast<std::size_t>(picture.width) + x);
        return static_cast<int>(picture.rgb[at]) - static_cast<int>(picture.rgb[at + 2]);
    };
    // The scale's ends differ by more than 90 of 255 between red and blue; 40 is half of that.
    EXPECT_LT(redMinusBlue(0.1, 0.1), -40);           // 0.1: cool
    EXPECT_GT(redMinusBlue(0.1, 0.9), 40);            // 1.8: warm
    EXPECT_LT(std::abs(redMinusBlue(0.9, 0.9)), 10);  // not a number: white
}

TEST(ReportGnuplot, WordsOfAChartAreNeverCommands) {
    const TemporaryFolder folder;
    Chart chart = fullChart();
    chart.title = "`touch " + (folder / "touched").string() + "`";
    chart.notes = {"\"; system('touch " + (folder / "touched").string() + "'); \"",
                   "'; system('touch " + (folder / "touched").string() + "'); '"};
    writeChart(chart, folder / "chart");
    EXPECT_FALSE(std::filesystem::exists(folder / "touched"));
}

// The message of an error with another PATH; empty without one.
std::string withPath(const std::filesystem::path& folder, const std::function<void()>& action) {
    const char* path = std::getenv("PATH");
    const std::string before = path == nullptr ? "" : path;
    ::setenv("PATH", folder.c_str(), 1);
    std::string said;
    try {
        action();
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::inputOutput);
        said = error.what();
    }
    ::setenv("PATH", before.c_str(), 1);
    return said;
}

TEST(ReportGnuplot, WithoutItTheErrorNamesThePackage) {
    const TemporaryFolder folder;
    std::string version = "?";
    const std::string said = withPath(folder.path(), [&] {
        version = gnuplotVersion();
        writeChart(fullChart(), folder / "chart");
    });
    EXPECT_EQ(version, "");
    EXPECT_TRUE(has(said, "gnuplot-nox")) << said;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_TRUE(gnuplotVersion().starts_with("gnuplot "));
}

TEST(ReportGnuplot, WhenItFailsTheErrorTellsWhatItSaid) {
    const TemporaryFolder folder, programs;
    test::writeText(programs / "gnuplot", "#!/bin/sh\necho it is broken >&2\nexit 3\n");
    std::filesystem::permissions(programs / "gnuplot", std::filesystem::perms::owner_all);
    const std::string said = withPath(programs.path(), [&] { writeChart(fullChart(), folder / "chart"); });
    EXPECT_TRUE(has(said, "gnuplot failed with exit code 3:\nit is broken")) << said;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ReportPalette, MethodsAreToldApartByMoreThanColour) {
    std::set<std::string> colours, looks;
    const char* names[] = {"euler",           "symplectic-euler", "heun",        "midpoint",       "rk4",
                           "velocity-verlet", "leapfrog",         "blanes-moan", "implicit-euler", "sdirk2"};
    for (const char* name : names) {
        const Style style = styleOf(name);
        colours.insert(style.colour);
        looks.insert(std::to_string(static_cast<int>(style.mark)) + (style.isFilled ? "f" : "o"));
    }
    EXPECT_EQ(colours.size(), std::size(names));
    EXPECT_EQ(looks.size(), std::size(names));
    EXPECT_EQ(styleOf("a new one").colour, styleOf("a new one").colour);
    EXPECT_FALSE(colours.contains(styleOf("a new one").colour));
}

}  // namespace
}  // namespace taut::report
