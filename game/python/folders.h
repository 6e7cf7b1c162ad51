// The folders of the module's files: installed beside it, or in the checkout that it was built from.
#pragma once

#include <filesystem>
#include <string>

namespace taut::python {

// As the program: $TAUT_ASSETS ($TAUT_SHADERS), share/taut of the prefix that the module is installed in, the checkout.
// Empty where there is none.
std::filesystem::path assetFolder();
std::filesystem::path shaderFolder();

// A file as named or, for a bare name such as "flag", the shipped scene or scenario. Throws core::Error(inputOutput).
std::filesystem::path sceneFile(const std::string& name);

// A name of that scene that holds in every working folder; a shipped scene's own. The name of a text need be no
// file's.
std::string lastingName(const std::string& name, bool isText);

}  // namespace taut::python
