// C++20 parts that the standard library of emscripten 3.1.6 (libc++ 13) lacks. Include it before all other headers.
#pragma once

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <string>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

// Of a decimal number without blanks and sign + before it, as std::from_chars takes it. strtod of this library rounds
// correctly and knows no locales.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const string text(first, last);
    const size_t digits = text.find_first_not_of('-') == 1 ? 1 : 0;
    const bool isDecimal = digits < text.size() && (text[digits] != '0' || (text[digits + 1] | 0x20) != 'x') &&
                           (text[digits] == '.' || (text[digits] >= '0' && text[digits] <= '9') ||
                            (text[digits] | 0x20) == 'i' || (text[digits] | 0x20) == 'n');
    if (!isDecimal) return {first, errc::invalid_argument};
    errno = 0;
    char* end = nullptr;
    const double number = strtod(text.c_str(), &end);
    if (end == text.c_str()) return {first, errc::invalid_argument};
    const char* after = first + (end - text.c_str());
    if (errno == ERANGE) return {after, errc::result_out_of_range};
    value = number;
    return {after, errc()};
}

}  // namespace std
