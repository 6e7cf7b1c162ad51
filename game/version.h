// The build of the program.
#pragma once

#include <string>

namespace taut::game {

// "1504895abc", followed by "-dirty" if files differed from the commit; "unknown" if built without git.
std::string commitText();

// "taut 0.1.0, commit 1504895abc, bits 3"
std::string versionText();

// "2026-11-22", from the changelog.
std::string versionDate();

}  // namespace taut::game
