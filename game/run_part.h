// A part of a run, and what it leaves in the folder of frames that the parts share: its frames, its record, its lock.
// It draws nothing.
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
    bool isShared = false;       // others draw the rest into the same folder; false: this run has the folder for itself
    std::string title;           // "--shard 3/8", "--frames 0-119"; empty for all frames

    // "run.json", or "run_0-119.json" of a part.
    std::string companion(const std::string& stem, const std::string& extension) const;
};

// What --frames, --shard and --from ask for; throws core::Error(usage) for frames and shards that there are not.
RunPart partOf(const RenderFlags& flags, const world::RunSpec& run);

// The folder of the frames, and who may write there.
struct PartPlace {
    image::FramePattern pattern;
    std::vector<std::string> besides;  // kinds of files beside the frames
    std::uint64_t key = 0;             // of the whole run
    bool resumes = false, mayOverwrite = false;

    std::vector<image::FramePattern> files() const { return pattern.with(besides); }
    // image::checksumOf() of frames that are drawn; 0 of one that somebody has taken away.
    std::vector<std::uint32_t> checksums(const pipeline::FrameSpan& frames) const;
};

// Locks the folder for parts of this run, and the part in it. `name` tells other runs who holds it. Throws
// core::Error(inputOutput).
std::vector<pipeline::RunLock> lockPart(const RunPart& part, const PartPlace& place, const std::string& name);

// Says so once where the file system knows no locks.
void noteMissingLocks(const std::vector<pipeline::RunLock>& locks);

// Begun: what lies there of its frames is its own.
enum class PartState { fresh, begun, complete };

// What has been done of the part, which `renderer` is to draw. Takes away what is to be replaced, frames that are not
// as the part's record says where it goes on, what another renderer or another version of the program has begun, and
// records of other runs where they may be overwritten or have drawn nothing; a run of another length is another one.
// Expects the lock. Throws core::Error(inputOutput) where they may not, or where nothing says of which run frames are
// that lie there.
PartState claimPart(const RunPart& part, const PartPlace& place, const std::string& renderer);

}  // namespace taut::game
