#include "game/messages.h"

#include <fmt/format.h>

#include <cstdio>

namespace taut::game {

void printError(const core::Error& error) {
    fmt::print(stderr, "{}{}\n", error.kind() == core::ErrorKind::badContent ? "" : "taut: ", error.what());
}

void printWarnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        fmt::print(stderr, "{}{}\n", warning.find("warning: ") == std::string::npos ? "taut: warning: " : "", warning);
}

}  // namespace taut::game
