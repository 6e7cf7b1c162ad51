// A part of a run, and its files in the folder of frames that the parts share: frames, record, lock. It draws nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "game/render_flags.h"
#include "taut/image/frame_sequence.h"
#include "taut/pipeline/run_lock.h"
#include "taut/pipeline/run_parts.h"

namespace taut::world {
struct RunSpec;
}

namespace taut::game {

struct RunPart {
    pipeline::FrameSpan frames;  // to be drawn
    std::int64_t count = 1;      // frames of the whole run
    bool isShared = false;       // others draw the rest into the same folder; false: this run has the folder alone
    std::string title;           // "--shard 3/8", "--frames 0-119"; empty for all frames

    // "run.json", or "run_0-119.json" for a part.
    std::string companion(const std::string& stem, const std::string& extension) const;
};

// The part by --frames, --shard and --from. Throws core::Error(usage) for frames or shards that do not exist.
RunPart partOf(const RenderFlags& flags, const world::RunSpec& run);

// The folder of the frames, and who may write into it.
struct PartPlace {
    image::FramePattern pattern;
    std::vector<std::string> besides;  // kinds of files beside the frames
    std::uint64_t key = 0;             // of the whole run
    bool resumes = false, mayOverwrite = false;

    std::vector<image::FramePattern> files() const { return pattern.with(besides); }
    // image::checksumOf() of drawn frames; 0 for a frame that somebody has removed.
    std::vector<std::uint32_t> checksums(const pipeline::FrameSpan& frames) const;
};

// Locks the folder for parts of this run, and the part in it. `name` tells other runs who holds the lock. Throws
// core::Error(inputOutput).
std::vector<pipeline::RunLock> lockPart(const RunPart& part, const PartPlace& place, const std::string& name);

// Says once that the file system has no locks.
void noteMissingLocks(const std::vector<pipeline::RunLock>& locks);

// Begun: frames of the part in the folder are its own.
enum class PartState { fresh, begun, complete };

// Finds the finished frames of the part that `renderer` will draw. Removes frames to be replaced, frames that differ
// from the record of a part that continues, and frames that another renderer or version of the program has begun.
// Removes records of other runs if they may be overwritten or have drawn nothing; a run of another length is another
// run. Expects the lock. Throws core::Error(inputOutput) if they may not be overwritten, or if no record names the run
// of existing frames.
PartState claimPart(const RunPart& part, const PartPlace& place, const std::string& renderer);

}  // namespace taut::game
