#include "taut/geometry/private/number_text.h"

#include <charconv>
#include <cmath>
#include <cstdint>

#include "taut/core/error.h"

namespace taut::geometry {
namespace {

constexpr double powers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr std::size_t longest = 40;  // characters of a number, an exponent included

// Writes to `at`, which has room for `longest`; returns the end.
char* put(char* at, double value, int digits) {
    const double scaled = std::fabs(value) * powers[digits];
    if (!(scaled < 9e15)) return std::to_chars(at, at + longest, value).ptr;  // beyond whole numbers in double
    auto units = static_cast<std::uint64_t>(scaled + 0.5);
    if (units == 0) {
        *at++ = '0';
        return at;
    }
    if (value < 0) *at++ = '-';
    int behind = digits;
    for (; behind > 0 && units % 10 == 0; --behind) units /= 10;
    const auto one = static_cast<std::uint64_t>(powers[behind]);
    at = std::to_chars(at, at + longest, units / one).ptr;
    if (behind == 0) return at;
    *at++ = '.';
    std::uint64_t rest = units % one;
    for (char* digit = at + behind; digit-- > at; rest /= 10) *digit = static_cast<char>('0' + rest % 10);
    return at + behind;
}

}  // namespace

void appendNumber(std::string& text, double value, int digits) {
    TAUT_EXPECTS(digits >= 1 && digits <= 9);
    char buffer[longest];
    text.append(buffer, put(buffer, value, digits));
}

void appendVectors(std::string& text, std::span<const glm::vec3> vectors, int digits) {
    TAUT_EXPECTS(digits >= 1 && digits <= 9);
    const std::size_t before = text.size();
    text.resize(before + vectors.size() * (3 * longest + 8) + 2);
    char* at = text.data() + before;
    *at++ = '[';
    for (const glm::vec3& vector : vectors) {
        *at++ = '(';
        for (int i = 0; i < 3; ++i) {
            at = put(at, static_cast<double>(vector[i]), digits);
            *at++ = i < 2 ? ',' : ')';
        }
        *at++ = ',';
    }
    if (!vectors.empty()) --at;
    *at++ = ']';
    text.resize(at - text.data());
}

void appendExactly(std::string& text, double value) {
    char buffer[longest];
    text.append(buffer, std::to_chars(buffer, buffer + longest, value).ptr);
}

}  // namespace taut::geometry
