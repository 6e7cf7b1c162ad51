// Where a run keeps its state and where it goes on from one that was kept. It knows no command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "taut/pipeline/run.h"
#include "taut/scene/load.h"
#include "taut/scene/private/used_files.h"

namespace taut::world {
class World;
}

namespace taut::game {

struct ContinuationFlags {
    std::int64_t every = 0;            // [frames] between two checkpoints; 0: none are kept
    std::string folder;                // of the checkpoints; empty: `checkpoints` beside the output
    bool resume = false;               // go on where the frames on disk end
    std::optional<std::int64_t> from;  // draw from this frame on
    bool mayOverwrite = false;         // frames that no state goes on from may be drawn again
    bool startsLate = false;           // states that lie in `folder` are looked for before the first frame to draw
    bool isWanted() const { return every > 0 || resume || from; }
};

void addContinuationFlags(Options& options, ContinuationFlags& flags);

// What a state and a picture have been made by, so that they are not taken for those of another scene.
struct RunKeys {
    std::function<std::uint64_t(std::int64_t frame)> state;  // of the state that goes on with that frame
    std::uint64_t picture = 0;
    std::vector<scene::UsedFile> files;  // that the scene depends on
};
// `look`: what else of the command line pictures depend on.
RunKeys runKeys(const scene::Loaded& scene, const std::vector<std::uint64_t>& look, const world::World& world);

// Of the whole run with that last frame: what its parts have in common.
std::uint64_t keyOfRun(const RunKeys& keys, std::int64_t lastOfAll);

// Pictures that may be on disk.
struct PicturesThere {
    std::string output;                  // empty: none are drawn
    std::vector<std::string> besides{};  // kinds of files beside them
    bool areOurs = false;                // a record says that those of this run's frames are
};

// Puts the world where the run is to go on, says so in the options, and returns the records of the frames before: for
// --from the last checkpoint at or before that frame, for --resume the last before the first frame that `pictures`
// lack, for a part that starts late the last before its first frame. Without any the run starts at frame 0. Prints what
// it does and what it had to pass over. Throws core::Error: badContent when the pictures on disk were made with other
// settings, inputOutput when no state goes on from them and they may not be overwritten, or when all that there is was
// recorded by other bits.
pipeline::RecordLog goOn(const ContinuationFlags& flags, const std::filesystem::path& folder, const RunKeys& keys,
                         const PicturesThere& pictures, pipeline::RunOptions& options, world::World& world);

// Lets the listener write every checkpoint of the run into the folder, and one of its start at once, so that whatever
// is killed can be resumed. Expects that the folder is there. Throws core::Error(inputOutput).
void keepCheckpoints(const std::filesystem::path& folder, const RunKeys& keys, const world::World& world,
                     pipeline::RunListener& listener);

}  // namespace taut::game
