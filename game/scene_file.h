// Finds and reads the scene given to a command. It knows no command.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "taut/scene/load.h"
#include "taut/spec/spec.h"

namespace taut::game {

// The file as named. A bare name means the shipped scene of that name, or else the shipped scenario. Throws
// core::Error(inputOutput), for a bare name with the nearest shipped scene.
std::filesystem::path sceneFile(const std::string& argument);

// How a file in `folder` names the scene: a shipped one by its name, another by the way from there.
std::string referenceTo(const std::filesystem::path& scene, const std::filesystem::path& folder);

// Options with the asset folder. A confined scene reads only files below its own folder and the shipped assets.
scene::LoadOptions loadOptions(const std::vector<std::string>& overrides = {}, bool isConfined = false);
void addConfinedFlag(Options& options, bool& isConfined);
void addOverrideFlag(Options& options, std::vector<std::string>& overrides,
                     const std::string& help = "Override a field: --set cloth.flag.cells=[72,48]; repeatable");

// Reads the scene with overrides ("key=value") and prints its warnings to standard error. Throws core::Error, also if
// the scene needs more memory than the machine can give.
world::SceneSpec readScene(const std::string& argument, const std::vector<std::string>& overrides,
                           bool isConfined = false);

// The same with the keys of its states.
scene::Loaded readSceneWithKeys(const std::string& argument, const std::vector<std::string>& overrides,
                                bool isConfined = false);

// Says which colliders of a scene take about a second to prepare, because a world says nothing while it is made.
std::string preparationText(const world::SceneSpec& spec);
void notePreparation(const world::SceneSpec& spec);

// Throws core::Error(usage) if results cannot be written into the file of a scene: with overrides they would not fit
// the file, and a scene that builds on others is only partly there.
void expectWritable(const std::filesystem::path& file, const world::SceneSpec& spec,
                    const std::vector<std::string>& overrides);

// Replaces a scene file that still holds `expected` by `content`. Links and permissions stay. Throws
// core::Error(inputOutput), also if somebody else has changed the file meanwhile.
void replaceSceneFile(const std::filesystem::path& file, const std::string& expected, const std::string& content);

}  // namespace taut::game
