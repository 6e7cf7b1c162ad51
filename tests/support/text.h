// Search for words in the output of a program.
#pragma once

#include <string>

namespace taut::test {

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace taut::test
