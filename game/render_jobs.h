// Draws a run by several processes of this program, each with a shard. It simulates nothing: the states from which
// shards go on exist already.
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

// The folder beside the output for the intermediate files of a run; removed with the object.
class JobsFolder {
  public:
    // Removes what a killed run has left. Throws core::Error(inputOutput), also while another run uses the folder.
    explicit JobsFolder(const std::filesystem::path& output);
    ~JobsFolder();
    JobsFolder(const JobsFolder&) = delete;
    JobsFolder& operator=(const JobsFolder&) = delete;

    std::filesystem::path states() const { return path_ / "states"; }
    // Where frames are drawn: into the output itself if it is a sequence of frames.
    std::filesystem::path frames() const { return frames_; }

  private:
    std::filesystem::path path_, frames_;
    pipeline::RunLock lock_;
};

// [frames] How often to keep states, so that shards of that many frames start shortly after one.
std::int64_t checkpointEveryFor(int jobs, std::int64_t frames);

// Draws the part's frames and proves that they are of the run with that key and these states. Passes them to `video`,
// if given, and finishes it. Removes the records of the shards. Returns the renderer that drew them, or none if `stop`
// became true; frames drawn so far stay. If a shard fails, throws core::Error with its exit code and message, and ends
// the other shards.
std::optional<render::RendererInfo> drawByJobs(const RenderFlags& flags, const RunPart& part, std::uint64_t key,
                                               const pipeline::RecordLog& states, const JobsFolder& folder,
                                               image::FrameSink* video, const std::atomic<bool>& stop);

// In a process started by drawByJobs(): makes it end with the process that started it.
void endWithStarter();

}  // namespace taut::game
