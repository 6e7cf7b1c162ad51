// Whether a list holds a value.
#pragma once

#include <algorithm>

namespace taut::core {

template <class Range, class Value>
bool contains(const Range& range, const Value& value) {
    return std::find(std::begin(range), std::end(range), value) != std::end(range);
}

}  // namespace taut::core
