#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "taut/report/gnuplot.h"
#include "taut/report/layout.h"

namespace taut::report {
namespace {

// Within double quotes gnuplot takes a backtick for a command to run, and a backslash for an escape.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        if (c == '`')
            out += "\\140";
        else if (c == '"' || c == '\\')
            out += std::string("\\") + c;
        else
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return out + "\"";
}

std::string number(double value) {
    return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN";
}

int dashType(Dash dash) {
    return 1 + static_cast<int>(dash);
}

// gnuplot's number of a mark, open or filled.
int pointType(Mark mark, bool isFilled) {
    static constexpr int open[] = {0, 6, 4, 8, 10, 12, 14, 2, 1, 3, 1};  // in the order of the enumeration
    const int type = open[static_cast<int>(mark)];
    return type + (type >= 4 && isFilled ? 1 : 0);
}

constexpr double stripRow = 11;  // [px] height of a row of the strip

// Where the strip of a panel begins, 0 … 1 of the panel; 1 without one.
double stripFoot(const Panel& panel, const PanelBox& box) {
    if (panel.strip.rows == 0) return 1;
    return 1 - (panel.strip.rows * stripRow + 6) / (box.top - box.bottom);
}

// The axis below a strip: marks in the strip have no value, so neither ticks nor numbers go on there. Powers of ten
// as many as have room. Other axes are as they were.
Axis belowStrip(Axis axis, double foot) {
    if (foot >= 1 || axis.scale != Scale::log || !axis.least || !axis.most || !axis.ticks.empty()) return axis;
    constexpr int mostNumbers = 10;
    const double first = std::log10(*axis.least), last = first + foot * (std::log10(*axis.most) - first);
    const int least = static_cast<int>(std::ceil(first)), most = static_cast<int>(std::floor(last));
    const int every = 1 + std::max(most - least, 0) / mostNumbers;
    for (int power = least - 1; power <= most; ++power) {
        const double decade = std::pow(10.0, power);
        if (power >= least) {
            const bool isMinor = power % every != 0;
            axis.ticks.push_back({decade, isMinor ? "" : fmt::format("10^{{{}}}", power), isMinor});
        }
        for (int digit = 2; every == 1 && digit <= 9; ++digit) {
            const double at = std::log10(digit * decade);
            if (at > first && at < last) axis.ticks.push_back({digit * decade, "", true});
        }
    }
    return axis;
}

class Script {
  public:
    Script(const Chart& chart, Format format) : chart_(chart), layout_(layoutOf(chart)) {
        const double scale = format == Format::png ? chart.pngScale : 1.0;
        const char* fonts = "DejaVu Sans,Verdana,Arial,sans-serif";
        if (format == Format::png)
            add("set terminal pngcairo size {:.0f},{:.0f} enhanced font 'DejaVu Sans,9.2' fontscale {} linewidth {} "
                "pointscale {} background '#ffffff'\n",
                layout_.width * scale, layout_.height * scale, scale, scale, scale);
        else
            add("set terminal svg size {:.0f},{:.0f} enhanced standalone font '{}' fontscale 1 background '#ffffff'\n"
                "set termoption font '{},12'\n",
                layout_.width, layout_.height, fonts, fonts);
        isPng_ = format == Format::png;
        add("set encoding utf8\nset multiplot\n");
        for (std::size_t i = 0; i < chart.panels.size(); ++i) addPanel(chart.panels[i], layout_.panels[i]);
        addFrame();
        add("unset multiplot\n");
    }

    std::string text;

  private:
    template <class... Parts>
    void add(fmt::format_string<Parts...> format, Parts&&... parts) {
        fmt::format_to(std::back_inserter(text), format, std::forward<Parts>(parts)...);
    }

    // A size in pixels as the terminal counts: cairo counts points of 1/72 inch at 96 pixels an inch.
    std::string font(double pixels) const { return fmt::format("',{:.2f}'", isPng_ ? pixels * 0.7667 : pixels); }
    double markSize(const Style& style) const { return (isPng_ ? 0.85 : 0.62) * style.size; }

    void begin(const PanelBox& box) {
        add("reset\nset encoding utf8\nset lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\n"
            "set tmargin at screen {}\nunset key\nset style textbox opaque noborder fillcolor rgb '#ffffff' margins "
            "0.4,0.3\n",
            number(box.left / layout_.width), number(box.right / layout_.width), number(box.bottom / layout_.height),
            number(box.top / layout_.height));
        elements_.clear();
    }

    // Data under a name of its own, for one element of the next plot command.
    std::string data(const std::string& rows) {
        const std::string name = fmt::format("$d{}", data_++);
        add("{} << TAUT_END\n{}TAUT_END\n", name, rows);
        return name;
    }

    void plot() {
        if (elements_.empty()) elements_.push_back("NaN");
        add("plot {}\n", fmt::join(elements_, ", \\\n  "));
    }

    void addAxis(char name, const Axis& axis);
    void addTicks(char name, const std::vector<Tick>& ticks);
    void addPanel(const Panel& panel, const PanelBox& box);
    void addRegion(const Region& region);
    void addGuide(const Panel& panel, const Guide& guide, double foot);
    void addLabel(const Label& label);
    void addMap(const HeatMap& map);
    void addArrows(const Arrows& arrows);
    void addCurve(const Curve& curve);
    void addStrip(const EdgeStrip& strip, const PanelBox& box, double foot);
    void addFrame();
    void addText(double x, double y, const std::string& words, double size, const char* colour);

    const Chart& chart_;
    ChartLayout layout_;
    bool isPng_ = false;
    bool hasColourBox_ = false;
    int data_ = 0;
    std::vector<std::string> elements_;
};

// The text at a tick is a format of its value: a per cent sign is written twice.
std::string tickText(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '%' ? "%%" : std::string(1, c);
    return report::quoted(out);
}

void Script::addTicks(char name, const std::vector<Tick>& ticks) {
    std::string list;
    for (const Tick& tick : ticks)
        list += fmt::format("{}{} {} {}", list.empty() ? "" : ", ", tick.isMinor ? "''" : tickText(tick.text),
                            number(tick.at), tick.isMinor ? 1 : 0);
    if (name == 'c')
        add("set cbtics ({})\n", list);
    else
        add("set {}tics ({})\n", name, list);
}

void Script::addAxis(char name, const Axis& axis) {
    if (axis.scale == Scale::log) add("set logscale {0} 10\nset format {0} '10^{{%L}}'\nset m{0}tics 10\n", name);
    std::string first = axis.least ? number(*axis.least) : "*", last = axis.most ? number(*axis.most) : "*";
    const bool isFixed = axis.least && axis.most;  // then the order of the ends turns the axis round
    if (axis.isReversed && isFixed) std::swap(first, last);
    add("set {}range [{}:{}] {}\n", name, first, last, axis.isReversed && !isFixed ? "reverse" : "noreverse");
    add("set {}tics nomirror scale 0.6,0.3 textcolor rgb '#303030'\n", name);
    if (!axis.ticks.empty()) addTicks(name, axis.ticks);
    if (!axis.hasNumbers) add("set format {} ''\n", name);
    if (!axis.ticks.empty() && !axis.hasNumbers) {
        std::vector<Tick> bare = axis.ticks;
        for (Tick& tick : bare) tick.text.clear();
        addTicks(name, bare);
    }
    if (!axis.label.empty())
        add("set {}label {} noenhanced textcolor rgb '#202020' offset {}\n", name, quoted(axis.label),
            name == 'x'       ? "0,0.2"
            : axis.hasNumbers ? "0.6,0"
                              : "2.5,0");
}

void Script::addPanel(const Panel& panel, const PanelBox& box) {
    begin(box);
    add("set border 3 lc rgb '#606060' lw 0.8\nset grid back lt 1 lc rgb '#e4e4e4' lw 0.6\n");
    const double foot = stripFoot(panel, box);
    addAxis('x', panel.x);
    addAxis('y', belowStrip(panel.y, foot));
    if (!panel.title.empty())
        add("set label {} noenhanced at graph 0, graph 1 offset screen 0, screen {} left font {} textcolor rgb "
            "'#202020'\n",
            quoted(panel.title), number(14 / layout_.height), font(13));
    for (const Region& region : panel.regions) addRegion(region);
    if (panel.map) addMap(*panel.map);
    for (const Guide& guide : panel.guides) addGuide(panel, guide, foot);
    for (const Arrows& arrows : panel.arrows) addArrows(arrows);
    for (const Curve& curve : panel.curves) addCurve(curve);
    if (panel.strip.rows > 0) addStrip(panel.strip, box, foot);
    for (const Label& label : panel.labels) addLabel(label);
    if (panel.map) add("set grid noxtics noytics\nset border 15\n");
    plot();
}

void Script::addRegion(const Region& region) {
    const auto end = [](const std::optional<double>& at, const char* edge) {
        return at ? "first " + number(*at) : std::string(edge);
    };
    add("set object rectangle from {}, {} to {}, {} behind fillcolor rgb '{}' fillstyle transparent solid {} "
        "noborder\n",
        end(region.x0, "graph 0"), end(region.y0, "graph 0"), end(region.x1, "graph 1"), end(region.y1, "graph 1"),
        region.colour, number(region.opacity));
}

void Script::addGuide(const Panel& panel, const Guide& guide, double foot) {
    const bool isUpright = guide.x.has_value();
    const double at = isUpright ? *guide.x : guide.y.value_or(0);
    const Axis& axis = isUpright ? panel.x : panel.y;
    if ((axis.least && at < *axis.least) || (axis.most && at > *axis.most)) return;
    const auto place = [&](double along) {
        return isUpright ? fmt::format("first {}, graph {}", number(at), number(along))
                         : fmt::format("graph {}, first {}", number(along), number(at));
    };
    add("set arrow from {} to {} nohead back lc rgb '{}' lw {} dt {}\n", place(0), place(isUpright ? foot : 1),
        guide.style.colour, number(guide.style.width), dashType(guide.style.dash));
    if (!guide.label.empty())
        add("set label {} noenhanced at {} left {} offset screen {}, screen {} font {} textcolor rgb '{}'\n",
            quoted(guide.label), place(guide.labelAt), isUpright ? "rotate by 90" : "",
            number(isUpright ? -7 / layout_.width : 0), number(isUpright ? 0 : 8 / layout_.height), font(10.5),
            guide.style.colour);
}

void Script::addLabel(const Label& label) {
    const char* align = label.align == Align::left ? "left" : label.align == Align::centre ? "center" : "right";
    const char* axes = label.isOnPanel ? "graph" : "first";
    add("set label {} noenhanced at {} {}, {} {} {} rotate by {} {} offset screen {}, screen {} font {} textcolor rgb "
        "'{}' front\n",
        quoted(label.text), axes, number(label.x), axes, number(label.y), align, number(label.angle),
        label.isBoxed ? "boxed" : "", number(label.dx / layout_.width), number(label.dy / layout_.height),
        font(label.size), label.colour);
}

void Script::addMap(const HeatMap& map) {
    std::string rows;
    for (int r = 0; r < map.rows; ++r)
        for (int c = 0; c < map.columns; ++c) {
            const double x = map.x0 + (map.columns > 1 ? (map.x1 - map.x0) * c / (map.columns - 1) : 0);
            const double y = map.y0 + (map.rows > 1 ? (map.y1 - map.y0) * r / (map.rows - 1) : 0);
            const double value = map.values[r * map.columns + c];
            rows +=
                fmt::format("{:.7g} {:.7g} {}\n", x, y, std::isfinite(value) ? fmt::format("{:.5g}", value) : "NaN");
        }
    if (chart_.colours) {
        const ColourScale& scale = *chart_.colours;
        std::string stops;
        for (const ColourStop& stop : scale.stops)
            stops += fmt::format("{}{} '{}'", stops.empty() ? "" : ", ", number(stop.at), stop.colour);
        add("set palette defined ({})\nset cbrange [{}:{}]\n", stops, number(scale.stops.front().at),
            number(scale.stops.back().at));
        if (!scale.ticks.empty()) addTicks('c', scale.ticks);
        const PanelBox& box = layout_.colours;
        if (hasColourBox_)
            add("unset colorbox\n");
        else
            add("set colorbox user origin screen {}, screen {} size screen {}, screen {} noborder\nset cbtics scale "
                "0.5\nset cblabel {} noenhanced\n",
                number(box.left / layout_.width), number(box.bottom / layout_.height),
                number((box.right - box.left) / layout_.width), number((box.top - box.bottom) / layout_.height),
                quoted(scale.label));
        hasColourBox_ = true;
    }
    elements_.push_back(data(rows) + " using 1:2:3 with image notitle");
}

void Script::addArrows(const Arrows& arrows) {
    std::string rows;
    for (const Arrow& a : arrows.arrows)
        rows += fmt::format("{} {} {} {}\n", number(a.x), number(a.y), number(a.dx), number(a.dy));
    if (rows.empty()) return;
    elements_.push_back(
        fmt::format("{} using 1:2:3:4 with vectors head filled size screen {}, 22 lc rgb '{}' lw {} "
                    "notitle",
                    data(rows), number(5 / layout_.width), arrows.colour, number(arrows.width)));
}

void Script::addCurve(const Curve& curve) {
    std::string rows, bars;
    for (const ChartPoint& p : curve.points) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
            rows += "\n";  // interrupts the line
            continue;
        }
        rows += fmt::format("{} {}\n", number(p.x), number(p.y));
        const auto end = [](double at, double instead) { return number(std::isfinite(at) ? at : instead); };
        if (std::isfinite(p.xLow) || std::isfinite(p.xHigh) || std::isfinite(p.yLow) || std::isfinite(p.yHigh))
            bars += fmt::format("{} {} {} {} {} {}\n", number(p.x), number(p.y), end(p.xLow, p.x), end(p.xHigh, p.x),
                                end(p.yLow, p.y), end(p.yHigh, p.y));
    }
    if (rows.find_first_not_of('\n') == std::string::npos) return;
    const Style& style = curve.style;
    const std::string name = data(rows);
    if (!bars.empty())
        elements_.push_back(fmt::format("{} using 1:2:3:4:5:6 with xyerrorbars pt -1 lc rgb '{}' lw 1 notitle",
                                        data(bars), style.colour));
    if (style.width > 0)
        elements_.push_back(fmt::format("{} using 1:2 with lines lc rgb '{}' lw {} dt {} notitle", name, style.colour,
                                        number(style.width), dashType(style.dash)));
    if (style.mark == Mark::none) return;
    const auto marks = [&](bool isFilled, const std::string& colour) {
        elements_.push_back(fmt::format("{} using 1:2 with points pt {} ps {} lc rgb '{}' lw 1.2 notitle", name,
                                        pointType(style.mark, isFilled), number(markSize(style)), colour));
    };
    if (!style.isFilled) marks(true, "#ffffff");
    marks(style.isFilled, style.colour);
}

void Script::addStrip(const EdgeStrip& strip, const PanelBox& box, double foot) {
    const double height = box.top - box.bottom;
    add("set object rectangle from graph 0, graph {} to graph 1, graph 1 back fillcolor rgb '#f2e9e4' fillstyle solid "
        "noborder\n",
        number(foot));
    add("set label {} noenhanced at graph 1, graph {} right offset screen {}, screen {} font {} textcolor rgb "
        "'#7a5548'\n",
        quoted(strip.label), number(foot), number(-5 / layout_.width), number(9 / layout_.height), font(10.5));
    for (const EdgeMark& mark : strip.marks) {
        const double y = 1.0 - (mark.row * stripRow + 9) / height, half = 0.5 * stripRow / height;
        if (mark.style.mark == Mark::bar) {
            add("set arrow from first {0}, graph {1} to first {0}, graph {2} nohead front lc rgb '{3}' lw 2\n",
                number(mark.x), number(y - half), number(y + half), mark.style.colour);
            continue;
        }
        add("set label '' at first {}, graph {} point pt {} ps {} lc rgb '{}' lw 1.2 front\n", number(mark.x),
            number(y), pointType(mark.style.mark, mark.style.isFilled), number(markSize(mark.style)),
            mark.style.colour);
    }
}

void Script::addText(double x, double y, const std::string& words, double size, const char* colour) {
    add("set label {} noenhanced at first {}, first {} left font {} textcolor rgb '{}'\n", quoted(words), number(x),
        number(y), font(size), colour);
}

// Title, legend and notes: a last plot over the whole picture whose axes count pixels.
void Script::addFrame() {
    begin({0, layout_.width, 0, layout_.height});
    add("unset border\nunset xtics\nunset ytics\nset xrange [0:{}]\nset yrange [0:{}]\n", number(layout_.width),
        number(layout_.height));
    if (!chart_.title.empty()) addText(layout_.left, layout_.title, chart_.title, 16, "#101010");
    if (!chart_.subtitle.empty()) addText(layout_.left, layout_.subtitle, chart_.subtitle, 12, "#505050");
    for (std::size_t i = 0; i < chart_.notes.size(); ++i)
        addText(layout_.left, layout_.notes[i], chart_.notes[i], 10, "#707070");
    for (const LegendEntry& entry : layout_.legend) {
        Style mark = entry.style;
        if (mark.width > 0)
            add("set arrow from first {}, first {} to first {}, first {} nohead back lc rgb '{}' lw {} dt {}\n",
                number(entry.x), number(entry.y), number(entry.x + sampleLength), number(entry.y), mark.colour,
                number(mark.width), dashType(mark.dash));
        mark.width = 0;
        if (mark.mark != Mark::none) addCurve({"", mark, {{entry.x + sampleLength / 2, entry.y}}});
        addText(entry.x + sampleLength + 7, entry.y, entry.title, 12, "#303030");
    }
    plot();
}

}  // namespace

std::string gnuplotScript(const Chart& chart, Format format) {
    return Script(chart, format).text;
}

}  // namespace taut::report
