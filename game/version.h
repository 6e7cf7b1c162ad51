// Which build of the program this is.
#pragma once

#include <string>

namespace taut::game {

// "1504895abc", with "-dirty" behind it where files differed from the commit; "unknown" when built away from git.
std::string commitText();

// "taut 0.1.0, commit 1504895abc, bits 3"
std::string versionText();

// "2026-11-22", of the changelog.
std::string versionDate();

}  // namespace taut::game
