// Adds the fabrics that a scene names to its tree. It uses the places of names of materials, not their meaning.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/document.h"

namespace taut::scene {

bool isFabric(std::string_view name);  // "fabric:denim"

// Adds [material."fabric:denim"] for each fabric that is a material of a body, or in the `like` of a material, and for
// the `like` of these fabrics. Returns their files. Reports missing fabrics, and files that cannot be read or have no
// material of their name. A material of the scene never replaces one of the library.
std::vector<std::string> addFabrics(const std::vector<std::filesystem::path>& assetFolders, Node& root,
                                    fields::Problems& problems);

}  // namespace taut::scene
