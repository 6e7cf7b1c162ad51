// Where a run keeps its states, and from which of them it goes on. It knows no command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "taut/image/frame_sequence.h"
#include "taut/pipeline/run.h"
#include "taut/scene/load.h"
#include "taut/scene/private/used_files.h"

namespace taut::world {
class World;
}

namespace taut::game {

struct ContinuationFlags {
    std::int64_t every = 0;            // [frames] between two checkpoints; 0: no checkpoints
    std::string folder;                // of the checkpoints; empty: `checkpoints` beside the output
    bool resume = false;               // goes on where the frames on disk end
    std::optional<std::int64_t> from;  // draws from this frame on
    bool mayOverwrite = false;         // frames without a state to go on from may be drawn again
    bool startsLate = false;           // looks in `folder` for states before the first frame to draw
    bool isWanted() const { return every > 0 || resume || from; }
};

void addContinuationFlags(Options& options, ContinuationFlags& flags);

// Numbers that identify the inputs of states and pictures, so that they are not used for another scene.
struct RunKeys {
    std::function<std::uint64_t(std::int64_t frame)> state;  // of the state from which that frame goes on
    std::uint64_t picture = 0;
    std::vector<scene::UsedFile> files;  // on which the scene depends
};
// `look`: further flags that change pictures.
RunKeys runKeys(const scene::Loaded& scene, const std::vector<std::uint64_t>& look, const world::World& world);

// The key of the whole run up to that last frame. Its parts share it.
std::uint64_t keyOfRun(const RunKeys& keys, std::int64_t lastOfAll);

// Pictures that may be on disk already.
struct PicturesThere {
    std::vector<image::FramePattern> files;  // of frames, and kinds beside them; none: none are drawn
    bool areOurs = false;                    // a record says that the frames of this run are its own
};

// Sets the world to the state from which the run continues, records it in the options, and returns the records of
// earlier frames. The state is the last checkpoint at or before: for --from that frame, for --resume the first missing
// frame of `pictures`, for a part that starts late its first frame. Without a checkpoint the run starts at frame 0.
// Prints the choice and the skipped checkpoints. Throws core::Error: badContent if the pictures on disk were made with
// other settings; inputOutput if no state leads to them and they may not be overwritten, or if all states were recorded
// by other bits.
pipeline::RecordLog goOn(const ContinuationFlags& flags, const std::filesystem::path& folder, const RunKeys& keys,
                         const PicturesThere& pictures, pipeline::RunOptions& options, world::World& world);

// Lets the listener write every checkpoint of the run into the folder. Writes one of its start at once, so that a
// killed run can always be resumed. `records`: digest of those of the frames before. Expects that the folder exists.
// Throws core::Error(inputOutput).
void keepCheckpoints(const std::filesystem::path& folder, const RunKeys& keys, const world::World& world,
                     std::uint64_t records, pipeline::RunListener& listener);

}  // namespace taut::game
