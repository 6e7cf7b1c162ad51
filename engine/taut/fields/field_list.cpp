#include "taut/fields/field_list.h"

#include <cstring>

namespace taut::fields {
namespace {

template <class T>
using List = std::vector<T>;
template <int N, class Scalar>
using Vec = glm::vec<N, Scalar, glm::defaultp>;

// Takes the numbers from `first` on.
template <int N, class Scalar>
void take(const std::vector<double>& numbers, std::size_t first, double factor, Vec<N, Scalar>& vector) {
    for (int i = 0; i < N; ++i) {
        const double number = numbers[first + static_cast<std::size_t>(i)];
        vector[i] = static_cast<Scalar>(std::is_integral_v<Scalar> ? number : number * factor);
    }
}
template <int N, class Scalar>
void append(const Vec<N, Scalar>& vector, double factor, std::vector<double>& numbers) {
    for (int i = 0; i < N; ++i) numbers.push_back(static_cast<double>(vector[i]) / factor);
}

// From a value of a file to a member of each type, and back.
void set(const Value& value, double factor, double& member) {
    member = std::get<double>(value) * factor;
}
void set(const Value& value, double, int& member) {
    member = static_cast<int>(std::get<std::int64_t>(value));
}
template <class Same>
requires std::is_constructible_v<Value, Same>
void set(const Value& value, double, Same& member) {
    member = std::get<Same>(value);
}
template <int N, class Scalar>
void set(const Value& value, double factor, Vec<N, Scalar>& member) {
    take(std::get<std::vector<double>>(value), 0, factor, member);
}
template <int N>
void set(const Value& value, double factor, List<Vec<N, double>>& member) {
    const auto& numbers = std::get<std::vector<double>>(value);
    member.clear();
    for (std::size_t i = 0; i < numbers.size(); i += N) take(numbers, i, factor, member.emplace_back());
}
void set(const Value& value, double, List<int>& member) {
    member.clear();
    for (const double number : std::get<std::vector<double>>(value)) member.push_back(static_cast<int>(number));
}
template <class Part>
void set(const Value& value, double factor, std::optional<Part>& member) {
    set(value, factor, member.emplace());
}

Value valueOf(double member, double factor) {
    return member / factor;
}
Value valueOf(int member, double) {
    return static_cast<std::int64_t>(member);
}
template <class Same>
requires std::is_constructible_v<Value, Same> Value valueOf(const Same& member, double) {
    return member;
}
Value valueOf(const List<double>& member, double) {
    return member.empty() ? Value() : Value(member);
}
template <int N, class Scalar>
Value valueOf(const Vec<N, Scalar>& member, double factor) {
    std::vector<double> numbers;
    append(member, factor, numbers);
    return numbers;
}
template <int N>
Value valueOf(const List<Vec<N, double>>& member, double factor) {
    std::vector<double> numbers;
    for (const auto& place : member) append(place, factor, numbers);
    return numbers.empty() ? Value() : Value(numbers);
}
Value valueOf(const List<int>& member, double) {
    return std::vector<double>(member.begin(), member.end());
}
template <class Part>
Value valueOf(const std::optional<Part>& member, double factor) {
    return member ? valueOf(*member, factor) : Value();
}

template <class Member>
const Member& memberAt(const void* spec, std::size_t offset) {
    return *reinterpret_cast<const Member*>(static_cast<const std::byte*>(spec) + offset);
}

}  // namespace

template <class Member>
void bind(Field& row, std::size_t offset, double factor) {
    row.write = [=](void* spec, const Value& value) { set(value, factor, memberAt<Member>(spec, offset)); };
    row.read = [=](const void* spec) { return valueOf(memberAt<Member>(spec, offset), factor); };
}

template void bind<double>(Field&, std::size_t, double);
template void bind<int>(Field&, std::size_t, double);
template void bind<std::int64_t>(Field&, std::size_t, double);
template void bind<bool>(Field&, std::size_t, double);
template void bind<std::string>(Field&, std::size_t, double);
template void bind<glm::dvec2>(Field&, std::size_t, double);
template void bind<glm::dvec3>(Field&, std::size_t, double);
template void bind<glm::ivec2>(Field&, std::size_t, double);
template void bind<glm::ivec3>(Field&, std::size_t, double);
template void bind<std::optional<double>>(Field&, std::size_t, double);
template void bind<std::optional<int>>(Field&, std::size_t, double);
template void bind<std::optional<std::string>>(Field&, std::size_t, double);
template void bind<std::optional<glm::dvec2>>(Field&, std::size_t, double);
template void bind<std::optional<glm::dvec3>>(Field&, std::size_t, double);
template void bind<List<double>>(Field&, std::size_t, double);
template void bind<List<int>>(Field&, std::size_t, double);
template void bind<List<std::string>>(Field&, std::size_t, double);
template void bind<List<glm::dvec2>>(Field&, std::size_t, double);
template void bind<List<glm::dvec3>>(Field&, std::size_t, double);

void bindStepLength(Field& row, std::size_t offset) {
    row.write = [=](void* spec, const Value& value) {
        const double* number = std::get_if<double>(&value);
        memberAt<std::optional<double>>(spec, offset) = number == nullptr ? std::nullopt : std::optional(*number);
    };
    row.read = [=](const void* spec) -> Value {
        const auto& member = memberAt<std::optional<double>>(spec, offset);
        return member ? Value(*member) : Value(std::string("auto"));
    };
}

void bindFlagOr(Field& row, std::size_t flag, std::size_t other) {
    row.write = [=](void* spec, const Value& value) {
        const bool* given = std::get_if<bool>(&value);
        memberAt<bool>(spec, flag) = given == nullptr || *given;
        memberAt<bool>(spec, other) = given == nullptr;
    };
    row.read = [=, word = row.choices.front()](const void* spec) -> Value {
        return memberAt<bool>(spec, other) ? Value(word) : Value(memberAt<bool>(spec, flag));
    };
}

void bindChoice(Field& row, std::size_t offset) {
    row.write = [=, choices = row.choices](void* spec, const Value& value) {
        const auto chosen = std::find(choices.begin(), choices.end(), std::get<std::string>(value));
        const auto number = static_cast<int>(chosen - choices.begin());
        std::memcpy(static_cast<std::byte*>(spec) + offset, &number, sizeof number);
    };
    row.read = [=, choices = row.choices](const void* spec) -> Value {
        int number = 0;
        std::memcpy(&number, static_cast<const std::byte*>(spec) + offset, sizeof number);
        return choices[number];
    };
}

void bindEntry(Field& row, std::size_t offset, double standard) {
    row.write = [=, key = row.key](void* spec, const Value& value) {
        memberAt<NumberMap>(spec, offset)[key] = std::get<double>(value);
    };
    row.read = [=, key = row.key](const void* spec) -> Value {
        const auto& numbers = memberAt<NumberMap>(spec, offset);
        const auto found = numbers.find(key);
        return found == numbers.end() ? standard : found->second;
    };
}

template <class Place>
void bindSegment(Field& row, std::size_t start, std::size_t end) {
    row.write = [=](void* spec, const Value& value) {
        const auto& numbers = std::get<std::vector<double>>(value);
        const auto half = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
        set(std::vector(numbers.begin(), half), 1.0, memberAt<Place>(spec, start));
        set(std::vector(half, numbers.end()), 1.0, memberAt<Place>(spec, end));
    };
    row.read = [=](const void* spec) -> Value {
        const Value first = valueOf(memberAt<Place>(spec, start), 1.0), last = valueOf(memberAt<Place>(spec, end), 1.0);
        const auto *numbers = std::get_if<std::vector<double>>(&first), *more = std::get_if<std::vector<double>>(&last);
        if (numbers == nullptr || more == nullptr) return {};
        std::vector<double> both = *numbers;
        both.insert(both.end(), more->begin(), more->end());
        return both;
    };
}
template void bindSegment<glm::dvec3>(Field&, std::size_t, std::size_t);
template void bindSegment<std::optional<glm::dvec2>>(Field&, std::size_t, std::size_t);
template void bindSegment<std::optional<glm::dvec3>>(Field&, std::size_t, std::size_t);

void enterAt(Field& row, std::size_t offset) {
    row.enter = [=](void* spec, const core::Source&) -> void* { return static_cast<std::byte*>(spec) + offset; };
}

Field& addField(std::vector<Field>& rows, std::string_view key, FieldKind kind, std::string_view unit, Range range,
                std::string_view help) {
    Field& row = rows.emplace_back();
    row.key = key;
    row.kind = kind;
    row.unit = unit;
    row.range = range;
    row.help = help;
    return row;
}

}  // namespace taut::fields
