// The folders of the program's files: assets, shaders and the manual, installed or in the source checkout.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::game {

// Looked for in this order: $TAUT_ASSETS ($TAUT_SHADERS), share/taut of the install prefix, the checkout from which the
// program was built. Empty if there is none. An environment variable that names no folder throws
// core::Error(inputOutput).
std::filesystem::path assetFolder();
std::filesystem::path shaderFolder();

// The pages of the manual: share/taut/manual of the prefix, else game/manual of the checkout; empty if there are none.
std::filesystem::path manualFolder();

// The engine for pages: share/taut/web of the prefix, else the build of game/web.sh in the checkout; empty if there is
// none.
std::filesystem::path webFolder();

// The font for labels: $TAUT_FONT, or the one that Debian installs; empty if there is none.
std::filesystem::path fontFile();
// The fixed-width font beside it, or the same font if there is none.
std::filesystem::path fixedFontFile();

// Names of the scenes in the asset folder, without ".toml", sorted.
std::vector<std::string> shippedScenes();
std::vector<std::string> shippedScenarios();  // found by name too
std::vector<std::string> manualPages();       // without ".md", sorted

}  // namespace taut::game
