// An object for JavaScript: it answers calls by name, with arguments and answers as JSON.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace taut::web {

using Json = nlohmann::json;

class Object {
  public:
    virtual ~Object() = default;
    // Throws core::Error.
    virtual Json call(const std::string& what, const Json& with) = 0;
};

// The functions of a class by name.
template <class Own>
using Calls = std::map<std::string_view, Json (*)(Own& own, const Json& with)>;

// An array that JavaScript sees in the engine's memory, until the next call.
template <class Number>
Json arrayOf(std::span<const Number> numbers, const char* type) {
    return {{"array", type}, {"at", reinterpret_cast<std::uintptr_t>(numbers.data())}, {"size", numbers.size()}};
}
inline Json bytesOf(std::span<const std::byte> bytes) {
    return arrayOf(bytes, "Uint8Array");
}
// Of vectors, one number after the other.
template <class Vector>
Json vectorsOf(std::span<const Vector> vectors) {
    using Number = typename Vector::value_type;
    const auto* first = reinterpret_cast<const Number*>(vectors.data());
    return arrayOf(std::span(first, vectors.size() * static_cast<std::size_t>(Vector::length())),
                   sizeof(Number) == 8 ? "Float64Array" : "Float32Array");
}

// Of bytes that JavaScript has laid into the engine's memory.
inline std::span<const std::byte> bytesIn(const Json& with) {
    const auto at = with.at("at").get<std::uintptr_t>();
    return {reinterpret_cast<const std::byte*>(at), with.at("size").get<std::size_t>()};
}

// A vector or a quaternion as its numbers.
template <class Vector>
Json numbersOf(const Vector& v) {
    Json numbers = Json::array();
    for (int i = 0; i < Vector::length(); ++i) numbers.push_back(v[i]);
    return numbers;
}
template <class Vector>
Vector vectorIn(const Json& numbers) {
    Vector v;
    for (int i = 0; i < Vector::length(); ++i) v[i] = numbers.at(static_cast<std::size_t>(i));
    return v;
}

}  // namespace taut::web
