// The state of a run in a file. A later run goes on from it as if the first had never stopped. It knows the files of
// one run; the caller gives a key that stands for everything in a scene that a state depends on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "taut/pipeline/run.h"
#include "taut/scene/private/used_files.h"
#include "taut/world/result_bits.h"

namespace taut::pipeline {

struct Checkpoint {
    std::int64_t frame = 0;                // that comes next; the world is at its time
    std::uint64_t state = 0;               // key of all that has made this state: scene, timeline so far, steps
    std::uint64_t picture = 0;             // key of all that has made the pictures before
    std::vector<std::byte> world;          // World::save()
    std::uint64_t records = 0;             // digest of the records of the frames before
    std::vector<scene::UsedFile> files{};  // that the scene depends on, to say which has changed
    int bits = world::resultBits;          // generation of results
};

void visit(core::Bytes& bytes, Checkpoint& checkpoint);

// A checkpoint that cannot be used.
struct PassedOver {
    std::string why;  // "FILE: …"
    bool isOfOtherBits = false;
};

// Whole or not at all; throws core::Error(inputOutput).
void writeCheckpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

// Throws core::Error: inputOutput, or badContent for a file that is foreign, damaged or of another version, or that
// needs more memory than maxBytes.
Checkpoint readCheckpoint(const std::filesystem::path& path, std::uint64_t maxBytes);

// The checkpoints of one run, in a folder: checkpoint_000120.taut goes on with frame 120. Beside them lie the records
// of all frames, once.
class CheckpointFolder {
  public:
    explicit CheckpointFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& path() const { return folder_; }
    std::filesystem::path pathOf(std::int64_t frame) const;
    std::filesystem::path records() const;
    std::vector<std::int64_t> framesThere() const;  // ascending

    // The last checkpoint at or before a frame that has its records and the state key that `keyOf` gives for its frame.
    // Unusable checkpoints are skipped, each with its reason; of checkpoints with other bits only the last one is
    // reported.
    std::optional<Checkpoint> latest(std::int64_t frame, const std::function<std::uint64_t(std::int64_t)>& keyOf,
                                     std::uint64_t maxBytes, std::vector<PassedOver>& refused) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace taut::pipeline
