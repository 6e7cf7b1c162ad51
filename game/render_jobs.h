// A run drawn by several processes of this program, each a shard. It simulates nothing: the states that shards go on
// from are there.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "game/render_flags.h"
#include "game/run_part.h"
#include "taut/image/frame_sink.h"
#include "taut/pipeline/record_log.h"
#include "taut/pipeline/run_lock.h"
#include "taut/render/renderer.h"

namespace taut::game {

// Where a run keeps what it needs on the way, beside its output; goes with the object.
class JobsFolder {
  public:
    // Empties what a killed run has left. Throws core::Error(inputOutput), also while another run uses it.
    explicit JobsFolder(const std::filesystem::path& output);
    ~JobsFolder();
    JobsFolder(const JobsFolder&) = delete;
    JobsFolder& operator=(const JobsFolder&) = delete;

    std::filesystem::path states() const { return path_ / "states"; }
    // Where frames are drawn to: the output itself where it is frames.
    std::filesystem::path frames() const { return frames_; }

  private:
    std::filesystem::path path_, frames_;
    pipeline::RunLock lock_;
};

// How often states are to be kept [frames], so that shards of that many frames begin shortly after one.
std::int64_t checkpointEveryFor(int jobs, std::int64_t frames);

// Draws the part's frames, proves that they are of the run with that key and these states, and gives them to `video` if
// there is one, which is finished then. The records of the shards are gone afterwards. Returns what drew them; none
// when `stop` became true: what was drawn so far stays. Throws core::Error of a shard's exit code with what it said;
// the others are ended then.
std::optional<render::RendererInfo> drawByJobs(const RenderFlags& flags, const RunPart& part, std::uint64_t key,
                                               const pipeline::RecordLog& states, const JobsFolder& folder,
                                               image::FrameSink* video, const std::atomic<bool>& stop);

// In a process that drawByJobs has started: makes it end with the one that did.
void endWithStarter();

}  // namespace taut::game
