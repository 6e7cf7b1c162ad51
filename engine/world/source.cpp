#include "taut/world/source.h"

namespace taut::world {

std::string at(const Source& source) {
    if (source.file.empty()) return "error: ";
    return source.file + ":" + std::to_string(source.line) + ":" + std::to_string(source.column) + ": error: ";
}

}  // namespace taut::world
