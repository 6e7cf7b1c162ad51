// Whether a list holds a value.
#pragma once

#include <algorithm>

namespace taut::core {

template <class Range, class Value>
bool contains(const Range& range, const Value& value) {
    return std::ranges::find(range, value) != std::ranges::end(range);
}

}  // namespace taut::core
