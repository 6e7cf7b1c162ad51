#include "game/render_flags.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "game/flags.h"
#include "game/renderers.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/image/private/video_writer.h"

namespace taut::game {

std::vector<std::string> allOverrides(const RenderFlags& flags) {
    std::vector<std::string> overrides = flags.overrides;
    addRunOverrides(flags.fps, flags.seconds, overrides);
    if (!flags.size.empty()) {
        const Size size = pictureSize(flags.size);
        overrides.push_back(overrideBy("--size", "picture.size", fmt::format("[{}, {}]", size.width, size.height)));
    }
    if (flags.samples > 0)
        overrides.push_back(overrideBy("--samples", "picture.samples", fmt::to_string(flags.samples)));
    addSmoothOverride(flags.smooth, overrides);
    if (!flags.camera.empty())
        overrides.push_back(overrideBy("--camera", "picture.camera", fmt::format("\"{}\"", flags.camera)));
    return overrides;
}

namespace {

void checkShard(const RenderFlags& flags) {
    (void)shard(flags.shard);
    if (flags.noPictures) failUsage("--shard divides the drawing: omit --no-pictures");
    if (!flags.video.empty() || image::isVideoPath(flags.output))
        failUsage("a shard draws frames: -o FOLDER; then taut join FOLDER -o {} makes the video",
                  flags.video.empty() ? flags.output : flags.video);
    if (flags.continuation.from) failUsage("--from and --shard exclude each other");
    if (flags.continuation.every > 0)
        failUsage(
            "states belong to the entire run: keep them by an earlier run, taut render SCENE --no-pictures "
            "--checkpoint-every 60 --checkpoints FOLDER, and give --checkpoints FOLDER to the shards");
    const std::string& states = flags.continuation.folder;
    std::error_code ignored;
    if (!states.empty() && !std::filesystem::is_directory(states, ignored))
        throw core::Error(
            core::ErrorKind::inputOutput,
            fmt::format("--checkpoints {}: there is no such folder; taut render SCENE --no-pictures --checkpoint-every "
                        "60 --checkpoints {} makes it, and without --checkpoints a shard simulates from frame 0 on",
                        states, states));
}

void checkStills(const RenderFlags& flags) {
    const std::pair<bool, const char*> ofRuns[] = {
        {!flags.frames.empty(), "--frames"},
        {!flags.shard.empty(), "--shard"},
        {!flags.video.empty(), "--video"},
        {flags.noPictures, "--no-pictures"},
        {flags.writesMetrics(), "--metrics"},
        {flags.hash, "--hash"},
        {!flags.state.empty(), "--keep-state"},
        {flags.continuation.isWanted() || !flags.continuation.folder.empty(), "checkpoints"},
    };
    for (const auto& [isGiven, name] : ofRuns)
        if (isGiven) failUsage("--at draws moments, not a run: omit {}", name);
    if (flags.output.empty()) failUsage("name an output for the picture: -o still.png");
    if (image::isVideoPath(flags.output)) failUsage("--at draws pictures, not a video: -o still.png");
    (void)framePattern(flags);
    checkLayerFlags(flags.layers, flags.output, flags.video);
}

}  // namespace

image::FramePattern framePattern(const RenderFlags& flags) {
    const std::filesystem::path output = flags.output;
    const bool hasNumbers = output.extension() != ".png" || output.filename().string().find('#') != std::string::npos;
    if (hasNumbers) return image::FramePattern(output);
    if (flags.at.size() > 1)
        failUsage("--at: {} moments need numbers in their names: -o {}_#.png", flags.at.size(),
                  (output.parent_path() / output.stem()).string());
    if (!flags.at.empty()) return image::FramePattern::ofOne(output, 0);
    const FrameRange range = flags.frames.empty() ? FrameRange() : frameRange(flags.frames);
    return range.last == range.first ? image::FramePattern::ofOne(output, range.first) : image::FramePattern(output);
}

void completeFlags(RenderFlags& flags) {
    if (flags.output.empty() && flags.at.empty() && !flags.noPictures)
        flags.output = std::filesystem::path(flags.scene).stem().string() + ".mp4";
}

void checkFlags(const RenderFlags& flags) {
    if (!flags.at.empty()) return checkStills(flags);
    if (!flags.output.empty() && !image::isVideoPath(flags.output)) (void)framePattern(flags);
    if (!flags.video.empty() && !image::isVideoPath(flags.video))
        failUsage("--video: the name must end in .mp4, .mov, .mkv, .webm or .gif");
    std::error_code ignored;
    if (!flags.video.empty() && std::filesystem::weakly_canonical(flags.video, ignored) ==
                                    std::filesystem::weakly_canonical(flags.output, ignored))
        failUsage("-o and --video name the same file");
    if (flags.output.empty() && flags.writesMetrics()) failUsage("--metrics writes a file beside the output: add -o");
    if (flags.continuation.isWanted() && flags.output.empty() && flags.continuation.folder.empty())
        failUsage("states are kept beside the output: add -o, or name a folder with --checkpoints FOLDER");
    if (flags.continuation.resume && (!flags.video.empty() || image::isVideoPath(flags.output)))
        failUsage("a video cannot be continued: --resume continues frames: -o out/frame_######.png");
    if (flags.continuation.resume && flags.overwrite.no) failUsage("--resume replaces frames: omit -n");
    if (flags.continuation.from && !flags.frames.empty()) failUsage("--from and --frames exclude each other");
    if (!flags.shard.empty()) checkShard(flags);
    checkLayerFlags(flags.layers, flags.output, flags.video);
}

namespace {

void addOutputFlags(Options& options, RenderFlags& flags) {
    options.group("Output");
    options.value("-o,--output", flags.output,
                  "out/frame_######.png, a folder, or a video (.mp4 .mov .mkv .webm .gif); default NAME.mp4");
    options.value("--video", flags.video, "A video in addition to the frames of -o").typeName("FILE");
    addOverwriteFlags(options, flags.overwrite);
    options.flag("--no-pictures", flags.noPictures, "Simulate only");
    options.flag("--metrics", flags.metrics,
                 "Write metrics.csv, or metrics_A-B.csv of a part: energy, momentum, strain, contacts of each frame");
    options.value("--metrics-of", flags.metricsOf, "Add these expressions of checks to the metrics, to 17 digits")
        .typeName("EXPR,…");
    options.flag("--hash", flags.hash, "Print the state hash of each frame");
    options.value("--hash-every", flags.hashEvery, "Print the state hash of each frame or each tick")
        .oneOf({"frame", "tick"})
        .each([&flags](const std::string&) { flags.hash = true; });
    options.flag("--quiet", flags.quiet, "Print no progress; only warnings and errors");
}

void addRangeFlags(Options& options, RenderFlags& flags) {
    options.group("Range");
    options
        .value("--frames", flags.frames,
               "Frames to draw: 0-119, 60, or 60-; from the last state before in --checkpoints")
        .typeName("A-B");
    options
        .value("--at", flags.at,
               "Draw the nearest tick to this time only, -o still.png. 1,2.5: several, numbered from 0, -o still_#.png")
        .typeName("SECONDS,…")
        .separatedBy(',')
        .oneValue()
        .check(numberWithin(0.0, mostSeconds));
    options
        .value("--shard", flags.shard,
               "Draw this of N pieces of the frames, 0/N to N-1/N, into a common folder; then taut join")
        .typeName("K/N");
    options.gone("--jobs",
                 "threads draw several pictures at once, and --shard divides them between processes: for k in 0 1 2 3; "
                 "do taut render SCENE -o FOLDER --shard $k/4 & done; wait; taut join FOLDER -o x.mp4");
    addRunFlags(options, flags.fps, flags.seconds);
}

void addLookFlags(Options& options, RenderFlags& flags) {
    options.group("Look");
    options.value("--size", flags.size, "Size of the pictures in pixels; videos round up to even sides")
        .typeName("WxH");
    options.value("--camera", flags.camera, "Camera of the scene").typeName("NAME");
    options
        .value("--samples", flags.samples,
               "Anti-aliasing: samples per pixel; 8 and 16 draw each picture two and four times")
        .oneOf({"1", "4", "8", "16"});
    addSmoothFlag(options, flags.smooth);
    const Option debug = options.flag("--debug", flags.debug, "Show points, springs coloured by strain, and contacts");
    options.flag("--overlay", flags.overlay,
                 "Show time, step and limit, largest strain, contacts between bodies, and a graph of the energies");
    addLayerFlags(options, flags.layers, debug);
}

void addGoingOnFlags(Options& options, RenderFlags& flags) {
    options.group("Going on");
    addContinuationFlags(options, flags.continuation);
    options
        .value("--keep-state", flags.state,
               "Keep the state of the last frame, as the start of other scenes: run.start = \"dressed.state\"")
        .typeName("FILE");
}

void addMachineFlags(Options& options, RenderFlags& flags) {
    options.group("Machine");
    addRendererFlag(options, flags.gl);
    addThreadsFlag(options, flags.threads);
}

}  // namespace

void addRenderFlags(Options& options, RenderFlags& flags) {
    options.value("SCENE", flags.scene, "A scene file, or the name of a shipped scene").required();
    options.group("Scene");
    addOverrideFlag(options, flags.overrides);
    addConfinedFlag(options, flags.isConfined);
    addOutputFlags(options, flags);
    addRangeFlags(options, flags);
    addLookFlags(options, flags);
    addGoingOnFlags(options, flags);
    addMachineFlags(options, flags);
    options.footer(
        "Examples:\n"
        "  taut render flag -o flag.mp4\n"
        "  taut render flag -o out/frame_######.png --size 640x360 --seconds 2\n"
        "  taut render flag -o still.png --at 2.5\n"
        "  taut render drape -o drape.webm --alpha\n"
        "  taut render show -o out/show --depth --mask\n"
        "  taut render show -o out/show --checkpoint-every 60 --resume\n"
        "  taut render flag -o out/flag --metrics-of \"position(cloth.flag@bottom-right).y,max_strain\"\n"
        "  taut render show -o out/show --shard 2/8 --checkpoints states --resume\n"
        "  taut render drape -o late.mp4 --frames 120-179 --set material.linen.bend_N_per_m=4");
}

}  // namespace taut::game
