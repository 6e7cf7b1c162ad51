// What a scene says that its run will refuse when its moment comes, found before the first tick. It knows no files.
#pragma once

#include <string>
#include <vector>


namespace taut::world {

struct SceneSpec;

struct Rehearsal {
    std::vector<std::string> faults;    // what ends the run, with file, line and column
    std::vector<std::string> warnings;  // of the world as it starts; and what may end the run: it depends on where
                                        // bodies are by then
    std::vector<std::string> advice;    // what would allow longer steps; how far ahead was looked
};

// Performs the timeline on bodies that stay where they start: that shows what can be held, cut or pushed at all. Where
// the verdict hangs on where a body is by then, the scene is played up to there if that is not dear (a second or two).
// Steps that will diverge are faults too. Throws core::Error where the scene cannot be built.
Rehearsal rehearse(const SceneSpec& scene);

}  // namespace taut::world
