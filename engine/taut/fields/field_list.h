// Builds the rows of the field table. Each field is one call with a pointer to its member. A row keeps the member's
// offset in the struct; field_list.cpp writes and reads members, once per type.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "taut/core/trig.h"
#include "taut/fields/field.h"

namespace taut::fields {

// Lets the row write and read a member. Numbers of the struct are `factor` times those of a file. A value that is not
// given is an optional without one; of lists of places and numbers, an empty one.
template <class Member>
void bind(Field& row, std::size_t offset, double factor = 1.0);
void bindStepLength(Field& row, std::size_t offset);               // std::optional<double>
void bindFlagOr(Field& row, std::size_t flag, std::size_t other);  // two of bool: the choice sets the other
void bindChoice(Field& row, std::size_t offset);                   // an enumeration of int, in the order of the choices
void bindEntry(Field& row, std::size_t offset, double standard);   // NumberMap, at the row's key
template <class Place>
void bindSegment(Field& row, std::size_t start, std::size_t end);  // two places
void enterAt(Field& row, std::size_t offset);                      // the struct of a table inside

Field& addField(std::vector<Field>& rows, std::string_view key, FieldKind kind, std::string_view unit, Range range,
                std::string_view help);

using NumberMap = std::map<std::string, double, std::less<>>;

template <class Member>
Member& memberAt(void* spec, std::size_t offset) {
    return *reinterpret_cast<Member*>(static_cast<std::byte*>(spec) + offset);
}

template <class Spec>
class FieldList {
  public:
    // A number that a file gives in another unit than the spec: spec = factor · file.
    template <class Number, class Base>  // double or std::optional<double>, of the struct or its base
    FieldList& number(const char* key, Number Base::*member, const char* unit, Range range, const char* help,
                      double factor = 1.0) {
        bind<Number>(add(key, FieldKind::number, unit, range, help), offsetOf(member), factor);
        return *this;
    }
    // A number of a part of the struct.
    template <class Number, class Part, class Base>  // double or std::optional<double>
    FieldList& number(const char* key, Part Base::*part, Number Part::*member, const char* unit, Range range,
                      const char* help) {
        bind<Number>(add(key, FieldKind::number, unit, range, help), offsetOf(part, member));
        return *this;
    }
    // One of several numbers in a map, found by its key; `standard` is its value if it is not given.
    template <class Base>
    FieldList& entry(std::string_view key, NumberMap Base::*member, std::string_view unit, Range range, double standard,
                     std::string_view help) {
        bindEntry(add(key, FieldKind::number, unit, range, help), offsetOf(member), standard);
        return *this;
    }
    template <class Number, class Base>
    FieldList& degrees(const char* key, Number Base::*member, Range range, const char* help) {
        return number(key, member, "degrees", range, help, core::radians(1.0));
    }
    template <class Whole, class Base>  // int or std::int64_t, or std::optional<int>
    FieldList& whole(const char* key, Whole Base::*member, const char* unit, Range range, const char* help) {
        bind<Whole>(add(key, FieldKind::whole, unit, range, help), offsetOf(member));
        return *this;
    }
    // A whole number of a part of the struct.
    template <class Part, class Base>
    FieldList& whole(const char* key, Part Base::*part, int Part::*member, const char* unit, Range range,
                     const char* help) {
        bind<int>(add(key, FieldKind::whole, unit, range, help), offsetOf(part, member));
        return *this;
    }
    FieldList& flag(const char* key, bool Spec::*member, const char* help) {
        bind<bool>(add(key, FieldKind::flag, "", anyNumber, help), offsetOf(member));
        return *this;
    }
    // A flag, or a word that sets both it and another.
    FieldList& flagOr(const char* key, bool Spec::*member, const char* word, bool Spec::*other, const char* help) {
        add(key, FieldKind::flagOrChoice, "", anyNumber, help).choices = {word};
        bindFlagOr(last(), offsetOf(member), offsetOf(other));
        return *this;
    }
    template <class Text, class Base>  // std::string or std::optional<std::string>
    FieldList& text(const char* key, Text Base::*member, Role role, const char* help) {
        bind<Text>(add(key, FieldKind::text, "", anyNumber, help), offsetOf(member));
        return this->role(role);
    }
    template <class Text, class Base>
    FieldList& choice(const char* key, Text Base::*member, std::vector<std::string> choices, const char* help) {
        add(key, FieldKind::choice, "", anyNumber, help).choices = std::move(choices);
        if constexpr (std::is_enum_v<Text>) {  // the choices are the enumerators in order, counted from 0
            static_assert(sizeof(Text) == sizeof(int));
            bindChoice(last(), offsetOf(member));
        } else {
            bind<Text>(last(), offsetOf(member));
        }
        return *this;
    }
    // "auto", which is none, or a number.
    FieldList& stepLength(const char* key, std::optional<double> Spec::*member, const char* help) {
        bindStepLength(add(key, FieldKind::stepLength, "s", Range{1e-9, 1.0}, help), offsetOf(member));
        return *this;
    }
    template <int N, class Scalar, class Base>
    FieldList& vector(const char* key, glm::vec<N, Scalar, glm::defaultp> Base::*member, const char* unit, Range range,
                      const char* help, double factor = 1.0) {
        const FieldKind kind = std::is_integral_v<Scalar> ? FieldKind::wholeVector : FieldKind::vector;
        return ofNumbers<N>(key, kind, member, unit, range, help, factor);
    }
    // A vector that may be left out.
    template <int N, class Base>
    FieldList& vector(const char* key, std::optional<glm::vec<N, double, glm::defaultp>> Base::*member,
                      const char* unit, Range range, const char* help, double factor = 1.0) {
        return ofNumbers<N>(key, FieldKind::vector, member, unit, range, help, factor);
    }
    template <class Vector, class Base>  // dvec3 or std::optional<dvec3>
    FieldList& rotation(const char* key, Vector Base::*member, const char* help) {
        return vector(key, member, "degrees", Range{-1e6, 1e6}, help, core::radians(1.0));
    }
    FieldList& direction(const char* key, glm::dvec3 Spec::*member, const char* help) {
        return ofNumbers<3>(key, FieldKind::direction, member, "", Range{-1e6, 1e6}, help);
    }
    template <class Colour, class Base>  // dvec3 or std::optional<dvec3>
    FieldList& colour(const char* key, Colour Base::*member, const char* help) {
        return ofNumbers<3>(key, FieldKind::colour, member, "", share, help);
    }
    FieldList& segment(const char* key, glm::dvec3 Spec::*start, glm::dvec3 Spec::*end, const char* help) {
        return segmentOf<3>(key, start, end, "m", Range{-1e6, 1e6}, help);
    }
    // Two points that may be left out, of two or three numbers each.
    template <int N>
    FieldList& segment(const char* key, std::optional<glm::vec<N, double, glm::defaultp>> Spec::*start,
                       std::optional<glm::vec<N, double, glm::defaultp>> Spec::*end, const char* unit, Range range,
                       const char* help) {
        return segmentOf<N>(key, start, end, unit, range, help);
    }
    template <int N, class Base>
    FieldList& places(const char* key, std::vector<glm::vec<N, double, glm::defaultp>> Base::*member, const char* unit,
                      Range range, const char* help) {
        return ofNumbers<N>(key, FieldKind::places, member, unit, range, help);
    }
    FieldList& wholes(const char* key, std::vector<int> Spec::*member, Range range, const char* help) {
        bind<std::vector<int>>(add(key, FieldKind::wholes, "", range, help), offsetOf(member));
        return *this;
    }
    // The value of another field.
    FieldList& numbers(const char* key, std::vector<double> Spec::*member, const char* help) {
        bind<std::vector<double>>(add(key, FieldKind::numbers, "", anyNumber, help), offsetOf(member));
        return *this;
    }
    FieldList& texts(const char* key, std::vector<std::string> Spec::*member, Role role, const char* help) {
        bind<std::vector<std::string>>(add(key, FieldKind::texts, "", anyNumber, help), offsetOf(member));
        return this->role(role);
    }

    // A text or several, of a part of the struct.
    template <class Part, class Base>
    FieldList& targets(const char* key, Part Base::*part, std::vector<std::string> Part::*member, Role role,
                       const char* help) {
        bind<std::vector<std::string>>(add(key, FieldKind::oneOrMoreTexts, "", anyNumber, help),
                                       offsetOf(part, member));
        return this->role(role);
    }

    // A table inside that may be left out, of a part of the struct.
    template <class Inside, class Part, class Base>
    FieldList& tableOr(const char* key, Part Base::*part, std::optional<Inside> Part::*member, Section section,
                       const char* help) {
        addInside(key, FieldKind::table, std::move(section), help).enter =
            [offset = offsetOf(part, member)](void* spec, const core::Source&) -> void* {
            return &memberAt<std::optional<Inside>>(spec, offset).emplace();
        };
        return *this;
    }
    // A table inside, for a member of the struct, or for the struct itself.
    template <class Part, class Base>
    FieldList& table(const char* key, Part Base::*member, Section section, const char* help) {
        return tableAt(key, offsetOf(member), std::move(section), help);
    }
    template <class Part, class Base>
    FieldList& table(const char* key, std::optional<Part> Base::*member, Section section, const char* help) {
        addInside(key, FieldKind::table, std::move(section), help).enter =
            [offset = offsetOf(member)](void* spec, const core::Source&) -> void* {
            auto& part = memberAt<std::optional<Part>>(spec, offset);
            return part ? &*part : &part.emplace();
        };
        return *this;
    }
    FieldList& tableOfSelf(const char* key, Section section, const char* help) {
        return tableAt(key, 0, std::move(section), help);
    }
    template <class Entry, class Base>
    FieldList& tables(const char* key, std::vector<Entry> Base::*member, Section section, const char* help) {
        Field& row = addInside(key, FieldKind::tables, std::move(section), help);
        row.enter = [offset = offsetOf(member)](void* spec, const core::Source& source) -> void* {
            Entry& entry = memberAt<std::vector<Entry>>(spec, offset).emplace_back();
            if constexpr (requires { entry.source; }) entry.source = source;
            return &entry;
        };
        row.entries = [offset = offsetOf(member)](void* spec) {
            std::vector<void*> entries;
            for (Entry& entry : memberAt<std::vector<Entry>>(spec, offset)) entries.push_back(&entry);
            return entries;
        };
        return *this;
    }

    // These functions change the field that was added last.
    FieldList& required() {
        last().required = true;
        return *this;
    }
    FieldList& only(std::vector<std::string> variants) {
        last().only = std::move(variants);
        return *this;
    }
    FieldList& inPlaceOf(const char* key) {
        last().inPlaceOf = key;
        return *this;
    }
    FieldList& goesWith(const char* key) {
        last().goesWith = key;
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
    // All fields so far that hold numbers.
    FieldList& allRamp(Affects affects) {
        for (Field& field : fields_)
            if (field.kind != FieldKind::flag && field.kind != FieldKind::text) field.ramp = affects;
        return *this;
    }

    std::vector<Field> take() { return std::move(fields_); }

  private:
    Field& last() { return fields_.back(); }
    Field& add(std::string_view key, FieldKind kind, std::string_view unit, Range range, std::string_view help) {
        return addField(fields_, key, kind, unit, range, help);
    }
    Field& addInside(const char* key, FieldKind kind, Section section, const char* help) {
        add(key, kind, "", anyNumber, help).inside.push_back(std::move(section));
        return last();
    }
    FieldList& tableAt(const char* key, std::size_t offset, Section section, const char* help) {
        enterAt(addInside(key, FieldKind::table, std::move(section), help), offset);
        return *this;
    }
    template <int N, class Member, class Base>
    FieldList& ofNumbers(const char* key, FieldKind kind, Member Base::*member, const char* unit, Range range,
                         const char* help, double factor = 1.0) {
        bind<Member>(add(key, kind, unit, range, help), offsetOf(member), factor);
        last().components = N;
        return *this;
    }
    template <int N, class Place>
    FieldList& segmentOf(const char* key, Place Spec::*start, Place Spec::*end, const char* unit, Range range,
                         const char* help) {
        bindSegment<Place>(add(key, FieldKind::segment, unit, range, help), offsetOf(start), offsetOf(end));
        last().components = N;
        return *this;
    }
    // [bytes] from the start of the struct.
    template <class Member>
    std::size_t distanceTo(const Member& member) const {
        return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&member) -
                                        reinterpret_cast<const std::byte*>(&sample_));
    }
    template <class Member, class Base>
    std::size_t offsetOf(Member Base::*member) const {
        return distanceTo(sample_.*member);
    }
    template <class Part, class Base, class Member>
    std::size_t offsetOf(Part Base::*part, Member Part::*member) const {
        return distanceTo((sample_.*part).*member);
    }

    std::vector<Field> fields_;
    const Spec sample_{};  // in which it is seen where members are
};

}  // namespace taut::fields
