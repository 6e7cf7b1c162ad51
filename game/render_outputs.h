// The files of a run of `taut render`: its pictures, and the records beside them. It plays nothing.
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

// The sink for all outputs that were asked for, or null. Asks before it overwrites.
std::unique_ptr<image::FrameSink> makeOutputs(const RenderFlags& flags, const RunPart& part, double fps);

// The path of a record of the part beside the output: run.json for "run", ".json".
std::filesystem::path recordPath(const RenderFlags& flags, const RunPart& part, const std::string& stem,
                                 const std::string& extension);

// The folder of states; empty if neither an output nor a folder is given.
std::filesystem::path checkpointFolder(const RenderFlags& flags);

// Writes the whole file or nothing; throws core::Error(inputOutput).
void writeWith(const std::filesystem::path& path, const std::function<void(const pipeline::Write&)>& writeAll);

// Writes run.json, and metrics.csv if asked for.
void writeRecords(const RenderFlags& flags, const RunPart& part,
                  const std::function<void(const pipeline::Write&)>& writeJson, const world::SceneSpec& spec,
                  const pipeline::RunResult& result, const std::vector<std::string>& figures);

}  // namespace taut::game
