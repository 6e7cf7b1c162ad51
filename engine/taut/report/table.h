// Tables as text: CSV for programs and columns for people. Independent of their contents.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace taut::report {

// A text, a number (in CSV with as many digits as it takes to read the same number again; not a number: empty), a whole
// number, a truth (0 or 1), or several texts (with commas between them).
using Cell = std::variant<std::string, double, long long, bool, std::vector<std::string>>;

struct TextTable {
    std::vector<std::string> columns;
    std::vector<std::vector<Cell>> rows;  // each as long as columns
};

// Comma-separated values after RFC 4180: a text with comma, quote or line break is quoted.
std::string csv(const TextTable& table);

// Columns padded with spaces, numbers with four digits and to the right.
std::string aligned(const TextTable& table);

}  // namespace taut::report
