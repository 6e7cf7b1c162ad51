// A chart as plain data: panels with curves, maps, arrows and marks on linear or logarithmic axes. Independent of the
// meaning of the numbers and of drawing.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace taut::report {

enum class Scale { linear, log };
enum class Mark { none, circle, square, triangle, down, diamond, pentagon, cross, plus, star, bar };
enum class Dash { solid, dashed, dotted, dashDotted };
enum class Align { left, centre, right };

struct Tick {
    double at = 0;
    std::string text{};    // empty with isMinor
    bool isMinor = false;  // short and without grid line
};

struct Axis {
    std::string label{};  // with its unit
    Scale scale = Scale::linear;
    std::optional<double> least{}, most{};  // none: from the data
    std::vector<Tick> ticks{};              // none: chosen; on a log axis powers of ten
    bool hasNumbers = true;                 // false in a panel that shares the axis with its neighbour
    bool isReversed = false;                // large values first
};

struct Style {
    std::string colour = "#404040";  // "#rrggbb"
    Mark mark = Mark::none;
    bool isFilled = true;  // of the mark; open marks hide the line behind them
    Dash dash = Dash::solid;
    double width = 1.8;  // [px] of the line; 0: marks only
    double size = 1.0;   // of the mark, 1 is about 7 px
};

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

struct ChartPoint {
    double x = 0, y = 0;
    // Ends of the error bars; NaN: no bar in that direction.
    double xLow = nothing, xHigh = nothing;
    double yLow = nothing, yHigh = nothing;
};

// Points joined in the order given; a NaN interrupts the line.
struct Curve {
    std::string title{};  // in the legend; curves of one title share one entry; empty: none
    Style style{};
    std::vector<ChartPoint> points{};
};

// A straight line over the whole panel at x or at y; exactly one of the two is given.
struct Guide {
    std::optional<double> x{}, y{};
    std::string label{};  // written along it
    Style style{"#707070", Mark::none, true, Dash::dashed, 1.2, 1.0};
    double labelAt = 0.03;  // where along it the label begins, 0 … 1 of the panel
};

// A shaded rectangle behind the curves; an end that is not given is the panel's edge.
struct Region {
    std::optional<double> x0{}, x1{}, y0{}, y1{};
    std::string colour = "#000000";
    double opacity = 0.07;  // 0 … 1
};

struct Label {
    double x = 0, y = 0;
    std::string text{};
    std::string colour = "#303030";
    Align align = Align::left;
    double dx = 0, dy = 0;   // [px] moved right and up
    double size = 11;        // [px]
    bool isBoxed = false;    // on a white box
    bool isOnPanel = false;  // x and y are 0 … 1 of the panel instead of values of the axes
    double angle = 0;        // [degrees] turned anticlockwise
};

// A mark in a strip along the upper edge for results without a place on the axes, such as a run that failed.
struct EdgeMark {
    double x = 0;
    int row = 0;    // from the top; each series has its own row
    Style style{};  // Mark::bar: an upright line, for a limit
};
struct EdgeStrip {
    std::string label{};  // "diverged"
    int rows = 0;         // 0: no strip
    std::vector<EdgeMark> marks{};
};

// Colours by value at the centres of a regular grid.
struct HeatMap {
    int columns = 0, rows = 0;
    double x0 = 0, x1 = 1;         // centres of the first and the last column
    double y0 = 0, y1 = 1;         // centres of the first and the last row
    std::vector<double> values{};  // (rows × columns), the first row at y0; NaN: left white
};

struct ColourStop {
    double at = 0;  // a value, ascending
    std::string colour{};
};
struct ColourScale {
    std::string label{};
    std::vector<ColourStop> stops{};  // at least two; values beyond the ends take the end's colour
    std::vector<Tick> ticks{};        // none: chosen
};

// A field of arrows, each from (x, y) by (dx, dy), all lengths in axis values.
struct Arrow {
    double x = 0, y = 0, dx = 0, dy = 0;
};
struct Arrows {
    std::vector<Arrow> arrows{};
    std::string colour = "#9a9a9a";
    double width = 1.0;  // [px]
};

// Drawn in this order: regions, map, guides, arrows, curves, strip, labels.
struct Panel {
    std::string title;
    Axis x, y;
    std::vector<Region> regions;
    std::optional<HeatMap> map;
    std::vector<Guide> guides;
    std::vector<Arrows> arrows;
    std::vector<Curve> curves;
    EdgeStrip strip;
    std::vector<Label> labels;

    // Writes a text on a white box, at 0 … 1 of the panel from its left and its lower edge.
    void note(double right, double up, std::string text, Align align = Align::left) {
        labels.push_back({.x = right,
                          .y = up,
                          .text = std::move(text),
                          .align = align,
                          .size = 10.5,
                          .isBoxed = true,
                          .isOnPanel = true});
    }
};

// Panels row by row. The size of the plotting areas is given, the picture grows around them; for a phase plane with
// equal scales choose panelWidth : panelHeight as the ranges of the axes are.
struct Chart {
    std::string title, subtitle;
    std::vector<Panel> panels;
    int columns = 0;                          // of panels; 0: all in one row
    int panelWidth = 460, panelHeight = 400;  // [px]
    std::optional<ColourScale> colours;       // of all maps
    bool hasLegend = true;
    std::vector<std::string> notes;  // small lines at the foot
    double pngScale = 2.0;           // pixels of the PNG for a pixel above
};

}  // namespace taut::report
