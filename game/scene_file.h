// Finds and reads the scene that a command was given. It knows no command.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "taut/scene/load.h"
#include "taut/spec/spec.h"

namespace taut::game {

// A file as named, or, for a bare name, the shipped scene or else scenario of that name. Throws
// core::Error(inputOutput), with the nearest shipped scene when it was a bare name.
std::filesystem::path sceneFile(const std::string& argument);

// With the asset folder. A confined scene reads files below its own folder and the shipped assets only.
scene::LoadOptions loadOptions(const std::vector<std::string>& overrides = {}, bool isConfined = false);
void addConfinedFlag(Options& options, bool& isConfined);

// Reads the scene with overrides ("key=value") and prints its warnings to standard error. Throws core::Error, also for
// a scene that needs more memory than the machine can give.
world::SceneSpec readScene(const std::string& argument, const std::vector<std::string>& overrides,
                           bool isConfined = false);

// The same with the keys of its states.
scene::Loaded readSceneWithKeys(const std::string& argument, const std::vector<std::string>& overrides,
                                bool isConfined = false);

// Says which colliders of a scene take a second or so to prepare; a world that is made of it is silent.
std::string preparationText(const world::SceneSpec& spec);
void notePreparation(const world::SceneSpec& spec);

// Puts `content` in the place of a scene file that still holds `expected`; a link stays one, permissions stay. Throws
// core::Error(inputOutput), also when someone else has changed the file meanwhile.
void replaceSceneFile(const std::filesystem::path& file, const std::string& expected, const std::string& content);

}  // namespace taut::game
