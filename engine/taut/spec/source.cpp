#include "taut/spec/source.h"

namespace taut::world {

std::string at(const Source& source) {
    if (source.file.empty()) return "error: ";
    return source.file + ":" + std::to_string(source.line) + ":" + std::to_string(source.column) + ": error: ";
}

std::string asWarning(std::string message) {
    static constexpr std::string_view error = "error: ";
    const std::size_t at = message.find(error);
    return at == std::string::npos ? message : message.replace(at, error.size(), "warning: ");
}

}  // namespace taut::world
