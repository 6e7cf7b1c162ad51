// Builds the rows of the field table. Each field is one call, which turns a member pointer into functions that write
// and read it.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "taut/core/trig.h"
#include "taut/fields/field.h"

namespace taut::fields {

// Numbers of a vector member, in order.
template <int N, class Scalar>
std::vector<double> numbersOf(const glm::vec<N, Scalar, glm::defaultp>& vector) {
    std::vector<double> numbers;
    for (int i = 0; i < N; ++i) numbers.push_back(static_cast<double>(vector[i]));
    return numbers;
}

template <class Vector>
Vector vectorOf(const std::vector<double>& numbers, std::size_t first = 0) {
    Vector vector;
    for (int i = 0; i < Vector::length(); ++i)
        vector[i] = static_cast<typename Vector::value_type>(numbers[first + static_cast<std::size_t>(i)]);
    return vector;
}

template <class Spec>
class FieldList {
  public:
    // A number that a file gives in another unit than the spec: spec = factor · file.
    template <class Number, class Base>  // double or std::optional<double>, of the struct or its base
    FieldList& number(const char* key, Number Base::*member, const char* unit, Range range, const char* help,
                      double factor = 1.0) {
        return add(
            key, FieldKind::number, unit, range, help,
            [=](Spec& s, const Value& value) { s.*member = std::get<double>(value) * factor; },
            [=](const Spec& s) -> Value {
                if constexpr (std::is_same_v<Number, double>)
                    return s.*member / factor;
                else
                    return s.*member ? Value(*(s.*member) / factor) : Value();
            });
    }
    // A number of a part of the struct.
    template <class Number, class Part, class Base>  // double or std::optional<double>
    FieldList& number(const char* key, Part Base::*part, Number Part::*member, const char* unit, Range range,
                      const char* help) {
        return add(
            key, FieldKind::number, unit, range, help,
            [=](Spec& s, const Value& value) { (s.*part).*member = std::get<double>(value); },
            [=](const Spec& s) -> Value {
                if constexpr (std::is_same_v<Number, double>)
                    return (s.*part).*member;
                else
                    return (s.*part).*member ? Value(*((s.*part).*member)) : Value();
            });
    }
    // One of several numbers in a map, found by its key; `standard` is its value if it is not given.
    template <class Numbers, class Base>
    FieldList& entry(std::string_view key, Numbers Base::*member, std::string_view unit, Range range, double standard,
                     std::string_view help) {
        const std::string name(key);
        return add(
            name.c_str(), FieldKind::number, std::string(unit).c_str(), range, std::string(help).c_str(),
            [=](Spec& s, const Value& value) { (s.*member)[name] = std::get<double>(value); },
            [=](const Spec& s) -> Value {
                const auto found = (s.*member).find(name);
                return found == (s.*member).end() ? standard : found->second;
            });
    }
    template <class Number, class Base>
    FieldList& degrees(const char* key, Number Base::*member, Range range, const char* help) {
        return number(key, member, "degrees", range, help, core::radians(1.0));
    }
    template <class Whole, class Base>  // int or std::int64_t, or std::optional<int>
    FieldList& whole(const char* key, Whole Base::*member, const char* unit, Range range, const char* help) {
        return add(
            key, FieldKind::whole, unit, range, help,
            [=](Spec& s, const Value& value) {
                if constexpr (std::is_integral_v<Whole>)
                    s.*member = static_cast<Whole>(std::get<std::int64_t>(value));
                else
                    s.*member = static_cast<int>(std::get<std::int64_t>(value));
            },
            [=](const Spec& s) -> Value {
                if constexpr (std::is_integral_v<Whole>)
                    return static_cast<std::int64_t>(s.*member);
                else
                    return s.*member ? Value(static_cast<std::int64_t>(*(s.*member))) : Value();
            });
    }
    // A whole number of a part of the struct.
    template <class Part, class Base>
    FieldList& whole(const char* key, Part Base::*part, int Part::*member, const char* unit, Range range,
                     const char* help) {
        return add(
            key, FieldKind::whole, unit, range, help,
            [=](Spec& s, const Value& value) { (s.*part).*member = static_cast<int>(std::get<std::int64_t>(value)); },
            [=](const Spec& s) -> Value { return static_cast<std::int64_t>((s.*part).*member); });
    }
    FieldList& flag(const char* key, bool Spec::*member, const char* help) {
        return add(
            key, FieldKind::flag, "", anyNumber, help,
            [=](Spec& s, const Value& value) { s.*member = std::get<bool>(value); },
            [=](const Spec& s) -> Value { return s.*member; });
    }
    // A flag, or a word that sets both it and another.
    FieldList& flagOr(const char* key, bool Spec::*member, const char* word, bool Spec::*other, const char* help) {
        add(
            key, FieldKind::flagOrChoice, "", anyNumber, help,
            [=](Spec& s, const Value& value) {
                const bool* flag = std::get_if<bool>(&value);
                s.*member = flag == nullptr || *flag;
                s.*other = flag == nullptr;
            },
            [=](const Spec& s) -> Value { return s.*other ? Value(std::string(word)) : Value(s.*member); });
        last().choices = {word};
        return *this;
    }
    template <class Text, class Base>  // std::string or std::optional<std::string>
    FieldList& text(const char* key, Text Base::*member, Role role, const char* help) {
        return add(
                   key, FieldKind::text, "", anyNumber, help,
                   [=](Spec& s, const Value& value) { s.*member = std::get<std::string>(value); },
                   [=](const Spec& s) -> Value {
                       if constexpr (std::is_same_v<Text, std::string>)
                           return s.*member;
                       else
                           return s.*member ? Value(*(s.*member)) : Value();
                   })
            .role(role);
    }
    template <class Text, class Base>
    FieldList& choice(const char* key, Text Base::*member, std::vector<std::string> choices, const char* help) {
        text(key, member, Role::none, help);
        last().kind = FieldKind::choice;
        last().choices = std::move(choices);
        return *this;
    }
    // The choices are the enumerators in order, counted from 0.
    template <class Enum, class Base>
    requires std::is_enum_v<Enum> FieldList& choice(const char* key, Enum Base::*member,
                                                    std::vector<std::string> choices, const char* help) {
        add(
            key, FieldKind::choice, "", anyNumber, help,
            [=](Spec& s, const Value& value) {
                for (std::size_t i = 0; i < choices.size(); ++i)
                    if (choices[i] == std::get<std::string>(value)) s.*member = static_cast<Enum>(i);
            },
            [=](const Spec& s) -> Value { return choices[static_cast<std::size_t>(s.*member)]; });
        last().choices = std::move(choices);
        return *this;
    }
    // "auto", which is none, or a number.
    FieldList& stepLength(const char* key, std::optional<double> Spec::*member, const char* help) {
        return add(
            key, FieldKind::stepLength, "s", Range{1e-9, 1.0}, help,
            [=](Spec& s, const Value& value) {
                if (const double* number = std::get_if<double>(&value))
                    s.*member = *number;
                else
                    s.*member = std::nullopt;
            },
            [=](const Spec& s) -> Value { return s.*member ? Value(*(s.*member)) : Value(std::string("auto")); });
    }
    template <int N, class Scalar, class Base>
    FieldList& vector(const char* key, glm::vec<N, Scalar, glm::defaultp> Base::*member, const char* unit, Range range,
                      const char* help, double factor = 1.0) {
        using Vector = glm::vec<N, Scalar, glm::defaultp>;
        constexpr bool isWhole = std::is_integral_v<Scalar>;
        add(
            key, isWhole ? FieldKind::wholeVector : FieldKind::vector, unit, range, help,
            [=](Spec& s, const Value& value) {
                s.*member = vectorOf<Vector>(std::get<std::vector<double>>(value));
                if constexpr (!isWhole) s.*member *= factor;
            },
            [=](const Spec& s) -> Value {
                std::vector<double> numbers = numbersOf(s.*member);
                for (double& number : numbers) number /= factor;
                return numbers;
            });
        last().components = N;
        return *this;
    }
    // A vector that may be left out.
    template <int N, class Base>
    FieldList& vector(const char* key, std::optional<glm::vec<N, double, glm::defaultp>> Base::*member,
                      const char* unit, Range range, const char* help, double factor = 1.0) {
        using Vector = glm::vec<N, double, glm::defaultp>;
        add(
            key, FieldKind::vector, unit, range, help,
            [=](Spec& s, const Value& value) {
                s.*member = vectorOf<Vector>(std::get<std::vector<double>>(value)) * factor;
            },
            [=](const Spec& s) -> Value { return s.*member ? Value(numbersOf(*(s.*member) / factor)) : Value(); });
        last().components = N;
        return *this;
    }
    template <class Vector, class Base>  // dvec3 or std::optional<dvec3>
    FieldList& rotation(const char* key, Vector Base::*member, const char* help) {
        return vector(key, member, "degrees", Range{-1e6, 1e6}, help, core::radians(1.0));
    }
    FieldList& direction(const char* key, glm::dvec3 Spec::*member, const char* help) {
        vector(key, member, "", Range{-1e6, 1e6}, help);
        last().kind = FieldKind::direction;
        return *this;
    }
    template <class Colour, class Base>  // dvec3 or std::optional<dvec3>
    FieldList& colour(const char* key, Colour Base::*member, const char* help) {
        add(
            key, FieldKind::colour, "", share, help,
            [=](Spec& s, const Value& value) {
                s.*member = vectorOf<glm::dvec3>(std::get<std::vector<double>>(value));
            },
            [=](const Spec& s) -> Value {
                if constexpr (std::is_same_v<Colour, glm::dvec3>)
                    return numbersOf(s.*member);
                else
                    return s.*member ? Value(numbersOf(*(s.*member))) : Value();
            });
        last().components = 3;
        return *this;
    }
    FieldList& segment(const char* key, glm::dvec3 Spec::*start, glm::dvec3 Spec::*end, const char* help) {
        add(
            key, FieldKind::segment, "m", Range{-1e6, 1e6}, help,
            [=](Spec& s, const Value& value) {
                s.*start = vectorOf<glm::dvec3>(std::get<std::vector<double>>(value));
                s.*end = vectorOf<glm::dvec3>(std::get<std::vector<double>>(value), 3);
            },
            [=](const Spec& s) -> Value {
                std::vector<double> numbers = numbersOf(s.*start);
                for (const double number : numbersOf(s.*end)) numbers.push_back(number);
                return numbers;
            });
        last().components = 3;
        return *this;
    }
    // Two points that may be left out, of two or three numbers each.
    template <int N>
    FieldList& segment(const char* key, std::optional<glm::vec<N, double, glm::defaultp>> Spec::*start,
                       std::optional<glm::vec<N, double, glm::defaultp>> Spec::*end, const char* unit, Range range,
                       const char* help) {
        using Vector = glm::vec<N, double, glm::defaultp>;
        add(
            key, FieldKind::segment, unit, range, help,
            [=](Spec& s, const Value& value) {
                s.*start = vectorOf<Vector>(std::get<std::vector<double>>(value));
                s.*end = vectorOf<Vector>(std::get<std::vector<double>>(value), N);
            },
            [=](const Spec& s) -> Value {
                if (!(s.*start) || !(s.*end)) return {};
                std::vector<double> numbers = numbersOf(*(s.*start));
                for (const double number : numbersOf(*(s.*end))) numbers.push_back(number);
                return numbers;
            });
        last().components = N;
        return *this;
    }
    template <int N, class Base>
    FieldList& places(const char* key, std::vector<glm::vec<N, double, glm::defaultp>> Base::*member, const char* unit,
                      Range range, const char* help) {
        using Vector = glm::vec<N, double, glm::defaultp>;
        add(
            key, FieldKind::places, unit, range, help,
            [=](Spec& s, const Value& value) {
                const auto& numbers = std::get<std::vector<double>>(value);
                (s.*member).clear();
                for (std::size_t i = 0; i < numbers.size(); i += N)
                    (s.*member).push_back(vectorOf<Vector>(numbers, i));
            },
            [=](const Spec& s) -> Value {
                if ((s.*member).empty()) return {};
                std::vector<double> numbers;
                for (const Vector& place : s.*member)
                    for (const double number : numbersOf(place)) numbers.push_back(number);
                return numbers;
            });
        last().components = N;
        return *this;
    }
    FieldList& wholes(const char* key, std::vector<int> Spec::*member, Range range, const char* help) {
        return add(
            key, FieldKind::wholes, "", range, help,
            [=](Spec& s, const Value& value) {
                (s.*member).clear();
                for (const double number : std::get<std::vector<double>>(value))
                    (s.*member).push_back(static_cast<int>(number));
            },
            [=](const Spec& s) -> Value { return std::vector<double>((s.*member).begin(), (s.*member).end()); });
    }
    // What another field may hold.
    FieldList& numbers(const char* key, std::vector<double> Spec::*member, const char* help) {
        return add(
            key, FieldKind::numbers, "", anyNumber, help,
            [=](Spec& s, const Value& value) { s.*member = std::get<std::vector<double>>(value); },
            [=](const Spec& s) -> Value { return (s.*member).empty() ? Value() : Value(s.*member); });
    }
    FieldList& texts(const char* key, std::vector<std::string> Spec::*member, Role role, const char* help) {
        return add(
                   key, FieldKind::texts, "", anyNumber, help,
                   [=](Spec& s, const Value& value) { s.*member = std::get<std::vector<std::string>>(value); },
                   [=](const Spec& s) -> Value { return s.*member; })
            .role(role);
    }

    // A text or several, of a part of the struct.
    template <class Part, class Base>
    FieldList& targets(const char* key, Part Base::*part, std::vector<std::string> Part::*member, Role role,
                       const char* help) {
        return add(
                   key, FieldKind::oneOrMoreTexts, "", anyNumber, help,
                   [=](Spec& s, const Value& value) {
                       (s.*part).*member = std::get<std::vector<std::string>>(value);
                   },
                   [=](const Spec& s) -> Value { return (s.*part).*member; })
            .role(role);
    }

    // A table inside that may be left out, of a part of the struct.
    template <class Inside, class Part, class Base>
    FieldList& tableOr(const char* key, Part Base::*part, std::optional<Inside> Part::*member, Section section,
                       const char* help) {
        return addInside(
            key, FieldKind::table, std::move(section), help,
            [=](Spec& s, const core::Source&) -> void* { return &((s.*part).*member).emplace(); });
    }
    // A table inside, for a member of the struct, or for the struct itself.
    template <class Part, class Base>
    FieldList& table(const char* key, Part Base::*member, Section section, const char* help) {
        return addInside(
            key, FieldKind::table, std::move(section), help,
            [=](Spec& s, const core::Source&) -> void* { return &(s.*member); });
    }
    template <class Part, class Base>
    FieldList& table(const char* key, std::optional<Part> Base::*member, Section section, const char* help) {
        return addInside(
            key, FieldKind::table, std::move(section), help,
            [=](Spec& s, const core::Source&) -> void* { return s.*member ? &*(s.*member) : &(s.*member).emplace(); });
    }
    FieldList& tableOfSelf(const char* key, Section section, const char* help) {
        return addInside(
            key, FieldKind::table, std::move(section), help, [](Spec& s, const core::Source&) -> void* { return &s; });
    }
    template <class Entry, class Base>
    FieldList& tables(const char* key, std::vector<Entry> Base::*member, Section section, const char* help) {
        addInside(key, FieldKind::tables, std::move(section), help, [=](Spec& s, const core::Source& source) -> void* {
            Entry& entry = (s.*member).emplace_back();
            if constexpr (requires { entry.source; }) entry.source = source;
            return &entry;
        });
        last().entries = [=](void* spec) {
            std::vector<void*> entries;
            for (Entry& entry : static_cast<Spec*>(spec)->*member) entries.push_back(&entry);
            return entries;
        };
        return *this;
    }

    // These four functions change the field that was added last.
    FieldList& required() {
        last().required = true;
        return *this;
    }
    FieldList& only(std::vector<std::string> variants) {
        last().only = std::move(variants);
        return *this;
    }
    // The only values of a whole number; they also give its range.
    FieldList& oneOf(std::vector<int> values) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        last().range = {static_cast<double>(*low), static_cast<double>(*high)};
        last().values = std::move(values);
        return *this;
    }
    FieldList& multipleOf(int divisor) {
        last().multipleOf = divisor;
        return *this;
    }
    FieldList& role(Role role) {
        last().role = role;
        return *this;
    }
    FieldList& ramps(Affects affects) {
        last().ramp = affects;
        return *this;
    }

    std::vector<Field> take() { return std::move(fields_); }

  private:
    Field& last() { return fields_.back(); }

    template <class Write, class Read>
    FieldList& add(const char* key, FieldKind kind, const char* unit, Range range, const char* help, Write write,
                   Read read) {
        Field& field = fields_.emplace_back();
        field.key = key;
        field.kind = kind;
        field.unit = unit;
        field.range = range;
        field.help = help;
        field.write = [write](void* spec, const Value& value) { write(*static_cast<Spec*>(spec), value); };
        field.read = [read](const void* spec) { return read(*static_cast<const Spec*>(spec)); };
        return *this;
    }
    template <class Enter>
    FieldList& addInside(const char* key, FieldKind kind, Section section, const char* help, Enter enter) {
        Field& field = fields_.emplace_back();
        field.key = key;
        field.kind = kind;
        field.help = help;
        field.inside.push_back(std::move(section));
        field.enter = [enter](void* spec, const core::Source& source) {
            return enter(*static_cast<Spec*>(spec), source);
        };
        return *this;
    }

    std::vector<Field> fields_;
};

}  // namespace taut::fields
