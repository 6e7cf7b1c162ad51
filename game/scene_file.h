// Finds and reads the scene that a command was given. It knows no command.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "world/spec.h"

namespace taut::game {

// A file as named, or, for a bare name, the shipped scene of that name. Throws core::Error(inputOutput), with the
// nearest shipped scene when it was a bare name.
std::filesystem::path sceneFile(const std::string& argument);

// Reads the scene with overrides ("key=value"), prints its warnings to standard error, and refuses one that needs more
// memory than the machine has. Throws core::Error.
world::SceneSpec readScene(const std::string& argument, const std::vector<std::string>& overrides);

void printWarnings(const std::vector<std::string>& warnings);

}  // namespace taut::game
