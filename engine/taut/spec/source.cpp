#include "taut/spec/source.h"

#include "taut/spec/mesh_data.h"

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

std::string meshFaultText(const MeshSource& source, const std::string& what, int triangle) {
    const auto number = static_cast<std::size_t>(triangle);  // a fault of no triangle is larger than any
    const std::vector<int>& lines = source.meshData->lines;
    return "cannot use this mesh: " + source.mesh + (number < lines.size() ? ":" + std::to_string(lines[number]) : "") +
           ": error: " + what;
}

}  // namespace taut::world
