#include "taut/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/utf8.h"

namespace taut::report {
namespace {

std::string csvText(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

// Numbers as the format says.
std::string textOf(const Cell& cell, const char* format) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (const auto* texts = std::get_if<std::vector<std::string>>(&cell))
        return fmt::format("{}", fmt::join(*texts, ", "));
    if (const auto* whole = std::get_if<long long>(&cell)) return fmt::format("{}", *whole);
    if (const auto* truth = std::get_if<bool>(&cell)) return *truth ? "1" : "0";
    const double value = std::get<double>(cell);
    return std::isnan(value) ? "" : fmt::format(fmt::runtime(format), value);
}

std::string exact(const Cell& cell) {
    return csvText(textOf(cell, "{}"));
}

std::string brief(const Cell& cell) {
    return core::printable(textOf(cell, "{:.4g}"), true);
}

// Characters, not bytes: names may hold letters beyond ASCII.
std::size_t widthOf(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::string csv(const TextTable& table) {
    std::string out;
    const auto line = [&](const auto& cells, const auto& text) {
        for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + text(cells[i]);
        out += "\n";
    };
    line(table.columns, csvText);
    for (const auto& row : table.rows) {
        TAUT_EXPECTS(row.size() == table.columns.size());
        line(row, exact);
    }
    return out;
}

std::string aligned(const TextTable& table) {
    std::vector<std::size_t> widths;
    for (const std::string& column : table.columns) widths.push_back(widthOf(column));
    for (const auto& row : table.rows) {
        TAUT_EXPECTS(row.size() == table.columns.size());
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], widthOf(brief(row[i])));
    }
    std::string out;
    const auto add = [&](std::size_t i, const std::string& text, bool isText) {
        const std::string room(widths[i] - widthOf(text), ' ');
        out += (i == 0 ? "" : "  ") + (isText ? text + room : room + text);
    };
    const auto endLine = [&] { out.erase(out.find_last_not_of(' ') + 1), out += "\n"; };
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        add(i, table.columns[i], table.rows.empty() || std::holds_alternative<std::string>(table.rows.front()[i]));
    endLine();
    for (const auto& row : table.rows) {
        for (std::size_t i = 0; i < row.size(); ++i) add(i, brief(row[i]), std::holds_alternative<std::string>(row[i]));
        endLine();
    }
    return out;
}

}  // namespace taut::report
