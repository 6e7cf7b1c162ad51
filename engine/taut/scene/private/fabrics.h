// Lays the fabrics that a scene names into its tree. It knows where names of materials stand, not what they mean.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/document.h"

namespace taut::scene {

bool isFabric(std::string_view name);  // "fabric:denim"

// Adds [material."fabric:denim"] for each fabric that is a material of a body, or that a material is like, and so on
// for those that fabrics are like. Returns their files. Reports fabrics that are not there, and files that cannot be
// read or have no material of their name. A material of the scene never stands in the place of one of the library.
std::vector<std::string> addFabrics(const std::vector<std::filesystem::path>& assetFolders, Node& root,
                                    fields::Problems& problems);

}  // namespace taut::scene
