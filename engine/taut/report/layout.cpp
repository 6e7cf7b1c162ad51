#include "taut/report/layout.h"

#include <algorithm>

namespace taut::report {
namespace {

constexpr double edge = 16;        // [px] around everything
constexpr double numbers = 62;     // left of an axis with numbers and a label
constexpr double fewNumbers = 44;  // without the label
constexpr double gap = 32;         // between panels that share an axis
constexpr double rowHeight = 22;   // of the legend
constexpr double noteHeight = 15;
constexpr double letter = 6.9;  // mean width of a letter at 12 px, of a wide font

std::vector<LegendEntry> entriesOf(const Chart& chart) {
    std::vector<LegendEntry> entries;
    if (!chart.hasLegend) return entries;
    for (const Panel& panel : chart.panels)
        for (const Curve& curve : panel.curves) {
            const bool isNew = std::none_of(entries.begin(), entries.end(),
                                            [&](const LegendEntry& e) { return e.title == curve.title; });
            if (!curve.title.empty() && isNew) entries.push_back({curve.title, curve.style});
        }
    return entries;
}

// Rows of equal columns, as many a row as fit; returns the height taken.
double placeLegend(std::vector<LegendEntry>& entries, double left, double right, double bottom) {
    if (entries.empty()) return 0;
    double widest = 0;
    for (const LegendEntry& entry : entries) widest = std::max(widest, static_cast<double>(entry.title.size()));
    const double column = sampleLength + 8 + widest * letter + 18;
    const auto count = static_cast<int>(entries.size());
    const int most = std::max(1, static_cast<int>((right - left) / column));
    const int rows = (count + most - 1) / most;
    const int perRow = (count + rows - 1) / rows;
    for (int i = 0; i < count; ++i) {
        entries[i].x = left + (i % perRow) * column;
        entries[i].y = bottom + (rows - 1 - i / perRow + 0.5) * rowHeight;
    }
    return rows * rowHeight + 8;
}

// Words at the ticks may need more than numbers.
double leftRoom(const Panel& panel) {
    if (!panel.y.hasNumbers) return panel.y.label.empty() ? gap : gap + 18;
    double words = 0;
    for (const Tick& tick : panel.y.ticks)
        words = std::max(words, letter * static_cast<double>(tick.text.size()) + (panel.y.label.empty() ? 6 : 26));
    return std::max(words, panel.y.label.empty() ? fewNumbers : numbers);
}

}  // namespace

ChartLayout layoutOf(const Chart& chart) {
    const auto count = static_cast<int>(chart.panels.size());
    const int columns = chart.columns > 0 ? std::min(chart.columns, std::max(count, 1)) : std::max(count, 1);
    const int rows = (count + columns - 1) / columns;
    const auto panelAt = [&](int row, int column) -> const Panel* {
        const int i = row * columns + column;
        return i < count ? &chart.panels[i] : nullptr;
    };

    // Across.
    ChartLayout layout;
    std::vector<double> lefts;
    double x = edge;
    for (int c = 0; c < columns; ++c) {
        double room = 0;
        for (int r = 0; r < rows; ++r)
            if (const Panel* panel = panelAt(r, c)) room = std::max(room, leftRoom(*panel));
        x += c == 0 ? room : std::max(room, gap);
        lefts.push_back(x);
        x += chart.panelWidth;
    }
    const double lastRight = x;
    layout.width = x + edge + (chart.colours ? 92 : 4);
    layout.left = edge;

    // Upwards from the foot: notes, legend, rows of panels, titles.
    double y = edge - 4;
    layout.notes.resize(chart.notes.size());
    for (std::size_t i = chart.notes.size(); i-- > 0; y += noteHeight) layout.notes[i] = y + noteHeight / 2;
    if (!chart.notes.empty()) y += 6;
    layout.legend = entriesOf(chart);
    y += placeLegend(layout.legend, lefts.empty() ? edge : lefts.front(), layout.width - edge, y);
    layout.panels.resize(chart.panels.size());
    layout.colours = {lastRight + 20, lastRight + 36, 0, 0};
    for (int r = rows - 1; r >= 0; --r) {
        double below = 6, above = 10;
        for (int c = 0; c < columns; ++c)
            if (const Panel* panel = panelAt(r, c)) {
                if (panel->x.hasNumbers) below = std::max(below, 24.0);
                if (!panel->x.label.empty()) below = std::max(below, 44.0);
                if (!panel->title.empty()) above = 28;
            }
        y += below;
        if (r == rows - 1) layout.colours.bottom = y;
        for (int c = 0; c < columns; ++c)
            if (panelAt(r, c) != nullptr)
                layout.panels[r * columns + c] = {lefts[c], lefts[c] + chart.panelWidth, y, y + chart.panelHeight};
        y += chart.panelHeight;
        layout.colours.top = y;
        y += above;
    }
    if (!chart.subtitle.empty()) layout.subtitle = y + 10, y += 20;
    if (!chart.title.empty()) layout.title = y + 12, y += 26;
    layout.height = y + edge - 6;
    return layout;
}

}  // namespace taut::report
