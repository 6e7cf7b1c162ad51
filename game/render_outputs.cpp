#include "game/render_outputs.h"

#include <fmt/format.h>

#include <chrono>
#include <string_view>

#include "game/layer_flags.h"
#include "game/outputs.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/private/several_sinks.h"
#include "taut/image/private/video_writer.h"

namespace taut::game {
namespace {

// The path of a file beside the output, named as by image::FrameSink::companion().
std::filesystem::path companionOf(const RenderFlags& flags, const std::string& name) {
    const std::filesystem::path output = flags.output;
    if (image::isVideoPath(output)) return output.parent_path() / fmt::format("{}.{}", output.stem().string(), name);
    return framePattern(flags).folder() / name;
}

// The records belong to the run: asked for or not, they are not replaced.
void expectNoRecord(const RenderFlags& flags, const RunPart& part) {
    for (const auto& [stem, extension] : {std::pair("run", ".json"), std::pair("metrics", ".csv")}) {
        const std::filesystem::path path = recordPath(flags, part, stem, extension);
        if (std::filesystem::exists(path) && (flags.writesMetrics() || stem == std::string("run")))
            throw core::Error(core::ErrorKind::inputOutput, fmt::format("{} exists already", path.string()));
    }
}

}  // namespace

std::unique_ptr<image::FrameSink> makeOutputs(const RenderFlags& flags, const RunPart& part, double fps) {
    const Overwrite overwrite = flags.continuation.resume ? Overwrite::yes : flags.overwrite.answer();
    std::vector<std::unique_ptr<image::FrameSink>> sinks;
    for (const std::string& output : {flags.output, flags.video}) {
        if (output.empty()) continue;
        if (image::isVideoPath(output)) {
            if (!flags.noPictures) permitOverwritingFile(output, overwrite);
            sinks.push_back(makeVideo(output, fps, flags.layers.alpha));
            continue;
        }
        const image::FramePattern frames = framePattern(flags);
        if (!flags.noPictures)
            permitOverwriting(frames.with(filesBeside(flags.layers)), part.frames.first, part.frames.last, overwrite);
        sinks.push_back(std::make_unique<image::FrameSequence>(frames));
    }
    if (overwrite == Overwrite::no && !flags.output.empty()) expectNoRecord(flags, part);
    if (sinks.empty()) return nullptr;
    if (!filesBeside(flags.layers).empty())
        sinks.push_back(std::make_unique<image::LayerSequence>(framePattern(flags)));
    return std::make_unique<image::SeveralSinks>(std::move(sinks));
}

std::filesystem::path recordPath(const RenderFlags& flags, const RunPart& part, const std::string& stem,
                                 const std::string& extension) {
    return companionOf(flags, part.companion(stem, extension));
}

std::filesystem::path checkpointFolder(const RenderFlags& flags) {
    if (!flags.continuation.folder.empty()) return flags.continuation.folder;
    return flags.output.empty() ? std::filesystem::path() : companionOf(flags, "checkpoints");
}

void writeWith(const std::filesystem::path& path, const std::function<void(const pipeline::Write&)>& writeAll) {
    core::WholeFile file(path, std::chrono::seconds(10));  // parts of one run may end at the same time
    writeAll([&](std::string_view text) { file.write(text); });
    file.commit();
}

void writeRecords(const RenderFlags& flags, const RunPart& part,
                  const std::function<void(const pipeline::Write&)>& writeJson, const world::SceneSpec& spec,
                  const pipeline::RunResult& result, const std::vector<std::string>& figures) {
    if (flags.writesMetrics())
        writeWith(recordPath(flags, part, "metrics", ".csv"),
                  [&](const pipeline::Write& write) { pipeline::writeMetricsCsv(write, spec, result, figures); });
    writeWith(recordPath(flags, part, "run", ".json"), writeJson);  // last: it says that all is there
}

}  // namespace taut::game
