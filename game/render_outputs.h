// What a run of `taut render` writes: its pictures, and the records beside them. It plays nothing.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "game/render_flags.h"
#include "game/run_part.h"
#include "taut/image/frame_sink.h"
#include "taut/pipeline/run_record.h"

namespace taut::game {

// Everything that was asked for, or null; asks before it overwrites. With --jobs frames are left to others.
std::unique_ptr<image::FrameSink> makeOutputs(const RenderFlags& flags, const RunPart& part, double fps);

// A record of the part beside the output: of run.json "run", ".json".
std::filesystem::path recordPath(const RenderFlags& flags, const RunPart& part, const std::string& stem,
                                 const std::string& extension);

// Where states are kept; empty without an output and a folder given.
std::filesystem::path checkpointFolder(const RenderFlags& flags);

// Whole or not at all; throws core::Error(inputOutput).
void writeWith(const std::filesystem::path& path, const std::function<void(const pipeline::Write&)>& writeAll);

// run.json, and metrics.csv if it was asked for.
void writeRecords(const RenderFlags& flags, const RunPart& part,
                  const std::function<void(const pipeline::Write&)>& writeJson, const world::SceneSpec& spec,
                  const pipeline::RunResult& result, const std::vector<std::string>& figures);

}  // namespace taut::game
