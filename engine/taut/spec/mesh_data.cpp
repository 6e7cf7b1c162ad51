#include "taut/spec/mesh_data.h"

namespace taut::world {

std::string meshFaultText(const MeshSource& source, const std::string& what, int triangle) {
    const auto number = static_cast<std::size_t>(triangle);  // a fault of no triangle is larger than any
    const std::vector<int>& lines = source.meshData->lines;
    const core::Source place{source.mesh, number < lines.size() ? lines[number] : 0};
    return "cannot use this mesh: " + printed(at(place) + what);
}

}  // namespace taut::world
