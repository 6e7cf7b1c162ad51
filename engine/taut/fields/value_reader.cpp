#include "taut/fields/private/value_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace taut::fields {

namespace {

class ValueReader {
  public:
    ValueReader(const Field& field, Problems& problems) : field_(field), problems_(problems) {}

    std::optional<Value> value(const Node& node) const {
        switch (field_.kind) {
            case FieldKind::number: return wrapped(number(node, field_.key));
            case FieldKind::whole: return whole(node);
            case FieldKind::flag: return flag(node);
            case FieldKind::flagOrChoice: return node.kind == NodeKind::flag ? flag(node) : choice(node);
            case FieldKind::text: return wrapped(text(node, field_.key));
            case FieldKind::choice: return choice(node);
            case FieldKind::stepLength: return stepLength(node);
            case FieldKind::vector:
            case FieldKind::wholeVector: return wrapped(numbers(node, field_.key));
            case FieldKind::direction: return direction(node);
            case FieldKind::colour: return wrapped(colour(node));
            case FieldKind::segment: return segment(node);
            case FieldKind::places: return places(node);
            case FieldKind::texts: return texts(node);
            case FieldKind::oneOrMoreTexts:
                if (node.kind == NodeKind::text) return Value(std::vector<std::string>{node.text});
                if (node.kind == NodeKind::list && node.items.empty()) return failKind(node);
                return texts(node);
            case FieldKind::wholes: return numberList(node);
            case FieldKind::numbers: return anyNumbers(node);
            case FieldKind::table:
            case FieldKind::tables: break;
        }
        return std::nullopt;
    }

  private:
    template <class T>
    static std::optional<Value> wrapped(std::optional<T> value) {
        if (!value) return std::nullopt;
        return Value(*std::move(value));
    }

    std::nullopt_t fail(const Node& node, const std::string& name, const std::string& expected,
                        const std::string& found, std::string remedy = {}) const {
        problems_.addError(node.place, fmt::format("{} must be {}, not {}", name, expected, found), std::move(remedy));
        return std::nullopt;
    }
    std::nullopt_t failKind(const Node& node) const {
        return fail(node, field_.key, description(field_), description(node));
    }

    std::optional<double> number(const Node& node, const std::string& name) const {
        const std::string unit = field_.unit.empty() ? "" : fmt::format(" [{}]", field_.unit);
        const bool isWhole = field_.kind == FieldKind::whole || field_.kind == FieldKind::wholeVector ||
                             field_.kind == FieldKind::wholes;
        if (node.kind == NodeKind::number && isWhole) return fail(node, name, "a whole number", description(node));
        if (node.kind != NodeKind::number && node.kind != NodeKind::whole)
            return fail(node, name, (isWhole ? "a whole number" : "a number") + unit, description(node));
        if (!std::isfinite(node.number)) return fail(node, name, "a finite number" + unit, description(node));
        const Range& range = field_.range;
        if (node.number >= range.low && node.number <= range.high) return node.number;
        const std::string found = description(node);
        // "Above 0" would not explain the fault of a number that is just too small or too large.
        if (range.low == smallest && node.number > 0.0) {
            const std::string suffix = field_.unit.empty() ? "" : " " + field_.unit;
            return fail(node, name, fmt::format("between {:g} and {:g}{}", range.low, range.high, suffix), found);
        }
        std::string expected = description(range, field_.unit);
        if (expected.empty() || (node.number > range.high && range.high == anyNumber.high))
            expected = fmt::format("at most {:g} in size", anyNumber.high);
        return fail(node, name, expected, found);
    }

    std::optional<Value> whole(const Node& node) const {
        const std::vector<int>& values = field_.values;
        if (node.kind == NodeKind::whole && !values.empty() &&
            std::find(values.begin(), values.end(), node.whole) == values.end())
            return failKind(node);
        if (!number(node, field_.key)) return std::nullopt;
        if (node.whole % field_.multipleOf != 0) return failKind(node);
        return Value(node.whole);
    }

    std::optional<Value> flag(const Node& node) const {
        if (node.kind != NodeKind::flag) return failKind(node);
        return Value(node.flag);
    }

    std::optional<std::string> text(const Node& node, const std::string& name) const {
        if (node.kind != NodeKind::text) return fail(node, name, "a text", description(node));
        // A path or a name with a zero byte or a line break in it can only be a trap.
        const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
        if (std::any_of(node.text.begin(), node.text.end(), isControl))
            return fail(node, name, "a text of one line", "one with control characters");
        return node.text;
    }

    std::optional<Value> choice(const Node& node) const {
        if (node.kind != NodeKind::text) return failKind(node);
        if (std::find(field_.choices.begin(), field_.choices.end(), node.text) != field_.choices.end())
            return Value(node.text);
        return fail(node, field_.key, description(field_), description(node), suggestion(node.text, field_.choices));
    }

    std::optional<Value> stepLength(const Node& node) const {
        if (node.kind == NodeKind::text && node.text == "auto") return Value(node.text);
        if (node.kind == NodeKind::text) return fail(node, field_.key, description(field_), description(node));
        if (node.kind != NodeKind::number && node.kind != NodeKind::whole) return failKind(node);
        return wrapped(number(node, field_.key));
    }

    std::optional<std::vector<double>> numbers(const Node& node, const std::string& name) const {
        const auto size = static_cast<std::size_t>(field_.components);
        const bool isWhole = field_.kind == FieldKind::wholeVector;
        const std::string unit = field_.unit.empty() ? "" : fmt::format(" [{}]", field_.unit);
        const std::string expected = fmt::format("a list of {} {}numbers{}", size, isWhole ? "whole " : "", unit);
        if (node.kind != NodeKind::list) return fail(node, name, expected, description(node));
        if (node.items.size() != size) return fail(node, name, expected, description(node));
        std::vector<double> values;
        for (std::size_t i = 0; i < size; ++i) {
            const std::optional<double> value = number(node.items[i], fmt::format("{}[{}]", name, i));
            if (value) values.push_back(*value);
        }
        if (values.size() != size) return std::nullopt;
        return values;
    }

    std::optional<Value> direction(const Node& node) const {
        const auto values = numbers(node, field_.key);
        if (!values) return std::nullopt;
        const auto isTiny = [](double x) { return std::abs(x) < smallest; };
        if (std::all_of(values->begin(), values->end(), isTiny)) {
            problems_.addError(node.place, fmt::format("{} must not be [0, 0, 0]", field_.key));
            return std::nullopt;
        }
        return Value(*values);
    }

    // Three numbers as a painting program has them, from 0 to 255.
    static bool isInBytes(const Node& list) {
        const auto isByte = [](const Node& n) { return n.kind == NodeKind::whole && n.whole >= 0 && n.whole <= 255; };
        return list.items.size() == 3 && std::all_of(list.items.begin(), list.items.end(), isByte) &&
               std::any_of(list.items.begin(), list.items.end(), [](const Node& n) { return n.whole > 1; });
    }
    std::nullopt_t failInBytes(const Node& list) const {
        const std::int64_t r = list.items[0].whole, g = list.items[1].whole, b = list.items[2].whole;
        return fail(list, field_.key, description(field_), fmt::format("[{}, {}, {}]", r, g, b),
                    fmt::format("write \"#{:02x}{:02x}{:02x}\"", r, g, b));
    }

    std::optional<std::vector<double>> colour(const Node& node) const {
        if (node.kind == NodeKind::list) return isInBytes(node) ? failInBytes(node) : numbers(node, field_.key);
        if (node.kind != NodeKind::text) return fail(node, field_.key, description(field_), description(node));
        std::vector<double> digits;
        for (const char c : node.text) {
            const std::size_t digit = std::string_view("0123456789abcdefABCDEF").find(c);
            if (digit != std::string_view::npos) digits.push_back(static_cast<double>(digit < 16 ? digit : digit - 6));
        }
        if (node.text.size() != 7 || node.text[0] != '#' || digits.size() != 6)
            return fail(node, field_.key, description(field_), description(node));
        return std::vector<double>{(16 * digits[0] + digits[1]) / 255, (16 * digits[2] + digits[3]) / 255,
                                   (16 * digits[4] + digits[5]) / 255};
    }

    std::optional<Value> segment(const Node& node) const {
        if (node.kind != NodeKind::list) return failKind(node);
        if (node.items.size() != 2) return fail(node, field_.key, description(field_), description(node));
        return places(node);
    }

    std::optional<Value> places(const Node& node) const {
        if (node.kind != NodeKind::list) return failKind(node);
        std::vector<double> values;
        for (std::size_t i = 0; i < node.items.size(); ++i)
            if (const auto place = numbers(node.items[i], fmt::format("{}[{}]", field_.key, i)))
                values.insert(values.end(), place->begin(), place->end());
        if (values.size() != node.items.size() * static_cast<std::size_t>(field_.components)) return std::nullopt;
        return Value(values);
    }

    std::optional<Value> numberList(const Node& node) const {
        if (node.kind != NodeKind::list) return failKind(node);
        std::vector<double> values;
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            const auto value = number(node.items[i], fmt::format("{}[{}]", field_.key, i));
            if (value) values.push_back(*value);
        }
        if (values.size() != node.items.size()) return std::nullopt;
        return Value(values);
    }

    // The field that it is for checks whether it fits.
    std::optional<Value> anyNumbers(const Node& node) const {
        if (node.kind == NodeKind::text) return wrapped(colour(node));
        if (node.kind == NodeKind::list) return numberList(node);
        const auto value = number(node, field_.key);
        if (!value) return std::nullopt;
        return Value(std::vector<double>{*value});
    }

    std::optional<Value> texts(const Node& node) const {
        if (node.kind == NodeKind::text)
            return fail(node, field_.key, description(field_), description(node),
                        node.text.size() > 40 ? "" : fmt::format("write {} = [\"{}\"]", field_.key, node.text));
        if (node.kind != NodeKind::list) return failKind(node);
        std::vector<std::string> values;
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            const auto value = text(node.items[i], fmt::format("{}[{}]", field_.key, i));
            if (value) values.push_back(*value);
        }
        if (values.size() != node.items.size()) return std::nullopt;
        return Value(values);
    }

    const Field& field_;
    Problems& problems_;
};

}  // namespace

std::optional<Value> fieldValue(const Field& field, const Node& node, Problems& problems) {
    return ValueReader(field, problems).value(node);
}

}  // namespace taut::fields
