// The library of fabrics: a file each in the `fabrics` of an asset folder, whose name is that of its one material.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::scene {

// "fabric:denim": how a scene names a material of the library.
inline constexpr const char* fabricPrefix = "fabric:";

// The files of all fabrics, sorted by name; of two with one name that of the earlier folder.
std::vector<std::filesystem::path> fabricFiles(const std::vector<std::filesystem::path>& assetFolders);

}  // namespace taut::scene
