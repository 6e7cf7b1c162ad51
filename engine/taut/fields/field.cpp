#include "taut/fields/field.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/fields/private/problems.h"

namespace taut::fields {

TAUT_VALUE_MEMBERS(Field);
TAUT_VALUE_MEMBERS(Section);

bool isName(const std::string& name) {
    return !name.empty() && name.size() <= 100 &&
           std::all_of(
               name.begin(), name.end(),
               [](char c) {
                   return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                          c == '_';
               });
}

Place CheckInput::at(const std::string& key) const {
    const Node* value = table.at(key);
    return value == nullptr ? place : value->place;
}

const Field* Section::find(const std::string& key) const {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.key == key; });
    return found == fields.end() ? nullptr : &*found;
}

std::vector<std::string> Section::keys() const {
    std::vector<std::string> names;
    for (const Field& field : fields) names.push_back(field.key);
    return names;
}

std::string description(const Range& range, const std::string& unit) {
    const std::string suffix = unit.empty() ? "" : " " + unit;
    const bool hasLow = range.low > anyNumber.low;
    const bool hasHigh = range.high < anyNumber.high;
    if (range.low == range.high) return fmt::format("{:g}{}", range.low, suffix);
    if (hasLow && hasHigh) return fmt::format("between {:g} and {:g}{}", range.low, range.high, suffix);
    if (hasHigh) return fmt::format("at most {:g}{}", range.high, suffix);
    if (range.low == smallest) return fmt::format("above 0{}", suffix);
    if (hasLow) return fmt::format("at least {:g}{}", range.low, suffix);
    return "";
}

std::string description(const Field& field) {
    const std::string unit = field.unit.empty() ? "" : fmt::format(" [{}]", field.unit);
    switch (field.kind) {
        case FieldKind::number: return "a number" + unit;
        case FieldKind::whole:
            if (!field.values.empty()) return fmt::format("{}{}", fmt::join(field.values, " or "), unit);
            return (field.multipleOf > 1 ? fmt::format("a multiple of {}", field.multipleOf) : "a whole number") + unit;
        case FieldKind::flag: return "true or false";
        case FieldKind::flagOrChoice: return fmt::format("true, false or \"{}\"", fmt::join(field.choices, "\" or \""));
        case FieldKind::text: return "a text";
        case FieldKind::choice: return "one of " + joined(field.choices);
        case FieldKind::stepLength: return "\"auto\" or a number" + unit;
        case FieldKind::vector: return fmt::format("a list of {} numbers{}", field.components, unit);
        case FieldKind::wholeVector: return fmt::format("a list of {} whole numbers{}", field.components, unit);
        case FieldKind::direction: return "a list of 3 numbers, not all 0";
        case FieldKind::colour: return "a list of 3 numbers from 0 to 1, or \"#rrggbb\"";
        case FieldKind::segment:
            return fmt::format("a list of two points, each a list of {} numbers{}", field.components, unit);
        case FieldKind::places:
            return fmt::format("a list of points, each a list of {} numbers{}", field.components, unit);
        case FieldKind::texts: return "a list of texts";
        case FieldKind::oneOrMoreTexts: return "a text or a list of texts";
        case FieldKind::wholes: return "a list of whole numbers";
        case FieldKind::numbers: return "a number, a list of numbers or \"#rrggbb\"";
        case FieldKind::table: return field.inside.front().alone.empty() ? "a table" : "a number or a table";
        case FieldKind::tables: return "a list of tables";
    }
    return "";
}

std::string defaultText(const Value& value) {
    const auto list = [](const std::vector<double>& numbers) {
        std::vector<std::string> words;
        for (const double number : numbers) words.push_back(fmt::format("{:.6g}", number));
        return "[" + joined(words) + "]";
    };
    if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
    if (const double* number = std::get_if<double>(&value)) return fmt::format("{:.6g}", *number);
    if (const auto* text = std::get_if<std::string>(&value)) return text->empty() ? "" : "\"" + *text + "\"";
    if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
        // A segment is two points.
        if (numbers->size() != 6) return list(*numbers);
        return "[" + list({numbers->begin(), numbers->begin() + 3}) + ", " +
               list({numbers->begin() + 3, numbers->end()}) + "]";
    }
    return "";
}

}  // namespace taut::fields
