// Numbers in text that people write.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace taut::core {

// The finite number that is all of the text, apart from blanks around it.
std::optional<double> numberIn(std::string_view text);

// The cells between the commas of a line, without surrounding blanks; one empty cell for an empty line.
std::vector<std::string_view> cellsOf(std::string_view line);

}  // namespace taut::core
