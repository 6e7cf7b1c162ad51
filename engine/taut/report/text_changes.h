// Which lines of a text are new and which have gone, for a person to read. It knows no files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::report {

struct TextChange {
    char sign = ' ';  // '-' was there, '+' is there now, ' ' is there still, '~' lines in between are left out
    int line = 0;     // from 1, of the text of this line; of a kept line in the new text
    std::string text;
};

// Changed lines with two of their neighbours, in order; empty when all lines are the same.
std::vector<TextChange> textChanges(std::string_view before, std::string_view now);

}  // namespace taut::report
