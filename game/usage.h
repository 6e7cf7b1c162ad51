// The error of an invalid command line.
#pragma once

#include <fmt/format.h>

#include <utility>

#include "taut/core/error.h"

namespace taut::game {

template <class... Values>
[[noreturn]] void failUsage(fmt::format_string<Values...> format, Values&&... values) {
    throw core::Error(core::ErrorKind::usage, fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace taut::game
