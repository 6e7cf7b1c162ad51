// Numbers and cells in text that people write.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::core {

// The finite number that is all of the text, apart from blanks around it.
std::optional<double> numberIn(std::string_view text);

// The whole number, not negative, whose digits are all of the text.
template <class Whole>
std::optional<Whole> wholeIn(std::string_view text) {
    Whole value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
    return value;
}

// A cell of CSV after RFC 4180: a text with comma, quote or line break is quoted.
std::string csvCell(const std::string& text);

// The cells between the commas of a line, without surrounding blanks; one empty cell for an empty line.
std::vector<std::string_view> cellsOf(std::string_view line);

}  // namespace taut::core
