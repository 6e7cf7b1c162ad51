#include "taut/check/private/function_table.h"

#include <fmt/format.h>

#include "taut/check/check.h"

namespace taut::check {

namespace {

const char* word(Takes takes) {
    switch (takes) {
        case Takes::bodies: return "BODIES";
        case Takes::points: return "POINTS";
        case Takes::place: return "PLACE";
        case Takes::number: return "NUMBER";
        case Takes::vector: return "VECTOR";
        case Takes::joint: return "JOINT";
        case Takes::axis: return "AXIS";
    }
    return "";
}

std::vector<Function> joinedTable() {
    std::vector<Function> table = pointFunctions();
    for (const auto& rows : {bodyFunctions(), gapFunctions(), jointFunctions(), numberFunctions()})
        table.insert(table.end(), rows.begin(), rows.end());
    return table;
}

}  // namespace

std::string Function::signature() const {
    std::string text = name + "(";
    for (std::size_t i = 0; i < takes.size(); ++i) text += fmt::format("{}{}", i > 0 ? ", " : "", word(takes[i]));
    return takes.empty() ? name : text + ")";
}

const std::vector<Function>& functionTable() {
    static const std::vector<Function> table = joinedTable();
    return table;
}

std::string functionsManual() {
    std::string out =
        "  Numbers and functions, + - * /, parentheses, compared by < <= > >= == !=, also in a chain:\n"
        "  \"0.1 < height(cloth.flag) < 0.2\". BODIES are KIND.NAME, POINTS are KIND.NAME@SELECTOR or all of a body,\n"
        "  a PLACE is POINTS, which stand for their centre of mass, or [x, y, z], a JOINT is the\n"
        "  name of joints, an AXIS x, y or z. Of a vector .x, .y and .z.\n\n";
    for (const Function& function : functionTable()) {
        const std::string unit = function.unit.empty() ? "" : fmt::format(" [{}]", function.unit);
        const char* kind = function.isVector ? "a vector" : "a number";
        const char* bare = function.mayBeBare ? "; without (…) of all bodies" : "";
        out += fmt::format("  {:<24} {}{}{}\n{:<27}{}\n", function.signature(), kind, unit, bare, "", function.help);
    }
    return out;
}

}  // namespace taut::check
