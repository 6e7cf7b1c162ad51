// An error or warning about a file or a run, with its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "taut/core/source.h"

namespace taut::core {

enum class Severity { error, warning };

struct Finding {
    Severity severity = Severity::error;
    Source source{};  // without a file where no place is known; without a line where it is all of the file, or a flag
    std::string text{};
    std::string remedy{};   // the correct text, unless `text` has it
    std::string excerpt{};  // the line of the file, and a caret below it
    bool operator==(const Finding&) const = default;
};

// Of a place, still without a text: at(source) + "it is too long".
Finding at(const Source& source);
Finding warningAt(const Source& source);
Finding operator+(Finding finding, std::string_view more);

// "file:line:column: error: text", and the excerpt with the remedy beside its caret; without a file the text alone.
std::string printed(const Finding& finding);
std::vector<std::string> printed(const std::vector<Finding>& findings);

}  // namespace taut::core
