// Names by pattern.
#pragma once

#include <string_view>

namespace taut::core {

// Whether the pattern, in which * stands for any characters, fits the whole name. Takes at most the product of their
// lengths.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace taut::core
