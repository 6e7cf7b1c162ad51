#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/continuation.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/folders.h"
#include "game/interruption.h"
#include "game/layer_flags.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/progress.h"
#include "game/renderers.h"
#include "game/scene_file.h"
#include "taut/check/figures.h"
#include "taut/core/error.h"
#include "taut/core/hash.h"
#include "taut/core/parallel.h"
#include "taut/core/whole_file.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/several_sinks.h"
#include "taut/image/video_writer.h"
#include "taut/pipeline/overlay.h"
#include "taut/pipeline/run.h"
#include "taut/pipeline/run_lock.h"
#include "taut/pipeline/run_record.h"
#include "taut/scene/load.h"

namespace taut::game {
namespace {

struct RenderFlags {
    std::string scene;
    std::string output, video;
    std::string frames, size, camera, gl, isa, hashEvery = "frame", metricsOf;
    double fps = 0.0, seconds = 0.0;
    int threads = 0, samples = 0, drawThreads = 0;
    std::vector<std::string> overrides;
    ContinuationFlags continuation;
    LayerFlags layers;
    bool yes = false, no = false, debug = false, metrics = false, quiet = false, hash = false, noPictures = false;
    bool overlay = false, isConfined = false;
    bool writesMetrics() const { return metrics || !metricsOf.empty(); }
};

// What --fps, --seconds, --size and --camera ask for, in the words of the scene format.
std::vector<std::string> allOverrides(const RenderFlags& flags) {
    std::vector<std::string> overrides = flags.overrides;
    if (flags.fps > 0.0) overrides.push_back(fmt::format("run.fps={}", flags.fps));
    if (flags.seconds > 0.0) overrides.push_back(fmt::format("run.seconds={}", flags.seconds));
    if (!flags.size.empty()) {
        const Size size = pictureSize(flags.size);
        overrides.push_back(fmt::format("picture.size=[{}, {}]", size.width, size.height));
    }
    if (flags.samples > 0) overrides.push_back(fmt::format("picture.samples={}", flags.samples));
    if (!flags.camera.empty()) overrides.push_back(fmt::format("picture.camera=\"{}\"", flags.camera));
    return overrides;
}

void checkFlags(const RenderFlags& flags) {
    const auto fail = [](const char* message) { throw core::Error(core::ErrorKind::usage, message); };
    if (!flags.output.empty()) checkOutputName(flags.output);
    if (!flags.video.empty() && flags.output.empty()) fail("--video is written besides -o: give -o too, or only -o");
    if (!flags.video.empty() && !image::isVideoPath(flags.video))
        fail("--video: the name must end in .mp4, .mov, .mkv, .webm or .gif");
    std::error_code ignored;
    if (!flags.video.empty() && std::filesystem::weakly_canonical(flags.video, ignored) ==
                                    std::filesystem::weakly_canonical(flags.output, ignored))
        fail("-o and --video name the same file");
    if (flags.output.empty() && !flags.noPictures)
        fail("say where the pictures go: -o out/frame_######.png, or -o out.mp4");
    if (flags.output.empty() && flags.writesMetrics()) fail("--metrics writes a file beside the output: add -o");
    if (flags.continuation.isWanted() && flags.output.empty() && flags.continuation.folder.empty())
        fail("states are kept beside the output: add -o, or say where with --checkpoints FOLDER");
    if (flags.continuation.resume && (!flags.video.empty() || image::isVideoPath(flags.output)))
        fail("a video cannot be continued: --resume goes on with frames, -o out/frame_######.png");
    if (flags.continuation.resume && flags.no) fail("--resume replaces frames: it does not go with -n");
    if (flags.continuation.from && !flags.frames.empty()) fail("--from and --frames exclude each other");
    checkLayerFlags(flags.layers, flags.output, flags.video);
}

pipeline::RunOptions runOptions(const RenderFlags& flags, const world::SceneSpec& spec) {
    const std::int64_t count = pipeline::frameCount(spec.run);
    FrameRange range = flags.frames.empty() ? FrameRange{} : frameRange(flags.frames);
    if (flags.continuation.from) range.first = *flags.continuation.from;
    const std::int64_t last = range.last.value_or(count - 1);
    if (range.first >= count || last >= count)
        throw core::Error(
            core::ErrorKind::usage,
            fmt::format("{}: the scene has frames 0-{}; --seconds makes it longer",
                        flags.frames.empty() ? fmt::format("--from {}", range.first) : "--frames " + flags.frames,
                        count - 1));
    pipeline::RunOptions options;
    options.firstFrame = range.first;
    options.lastFrame = last;
    options.debugView = flags.debug;
    expose(flags.layers, options);
    options.checkpointEvery = flags.continuation.every;
    // Who goes on from a checkpoint may want the figures of the frames before it.
    options.metrics = flags.writesMetrics() || flags.overlay || !flags.quiet || options.checkpointEvery > 0;
    return options;
}

// What --metrics-of asks for, or null.
std::shared_ptr<check::Figures> figuresOf(const std::string& text, const world::SceneSpec& spec) {
    if (text.empty()) return nullptr;
    const auto fail = [](const std::string& message) {
        throw core::Error(core::ErrorKind::usage, "--metrics-of: " + message);
    };
    try {
        auto figures = std::make_shared<check::Figures>(check::Figures::parse(text));
        for (const check::Mention& mention : figures->mentions())
            if (const std::string fault = scene::targetFault(spec, mention.target, mention.hasPoints, mention.against);
                !fault.empty())
                fail(fault);
        return figures;
    } catch (const check::Fault& fault) {
        fail(fmt::format("{} (at \"{}\"){}", fault.what(), text.substr(std::min(fault.at, text.size()), 30),
                         fault.remedy.empty() ? "" : "; " + fault.remedy));
    }
    return nullptr;
}

pipeline::FigureColumns columnsOf(const std::vector<std::string>& names) {
    core::Hash key;
    for (const std::string& name : names) key.add(name);
    return {names.size(), key.value()};
}

// Everything that was asked for, or null; asks before it overwrites.
std::unique_ptr<image::FrameSink> makeOutputs(const RenderFlags& flags, const pipeline::RunOptions& options,
                                              double fps) {
    const Overwrite overwrite = flags.yes || flags.continuation.resume ? Overwrite::yes
                                : flags.no                             ? Overwrite::no
                                                                       : Overwrite::ask;
    std::vector<std::unique_ptr<image::FrameSink>> sinks;
    for (const std::string& output : {flags.output, flags.video}) {
        if (output.empty()) continue;
        if (!flags.noPictures)
            permitOverwriting(output, options.firstFrame, options.lastFrame, overwrite,
                              image::isVideoPath(output) ? std::vector<std::string>() : filesBeside(flags.layers));
        sinks.push_back(makeSink(output, fps, flags.layers.alpha));
    }
    if (sinks.empty()) return nullptr;
    if (!filesBeside(flags.layers).empty())
        sinks.push_back(
            std::make_unique<image::LayerSequence>(image::FramePattern(flags.output), depthComment(flags.layers)));
    auto sink = std::make_unique<image::SeveralSinks>(std::move(sinks));
    if (overwrite == Overwrite::no)  // the records belong to the run: asked for or not, they are not replaced
        for (const char* record : {"run.json", "metrics.csv"})
            if (std::filesystem::exists(sink->companion(record)) &&
                (flags.writesMetrics() || record == std::string("run.json")))
                throw core::Error(core::ErrorKind::inputOutput,
                                  fmt::format("{} exists already", sink->companion(record).string()));
    return sink;
}

std::filesystem::path checkpointFolder(const RenderFlags& flags, const image::FrameSink* sink) {
    if (!flags.continuation.folder.empty()) return flags.continuation.folder;
    return sink != nullptr ? sink->companion("checkpoints") : std::filesystem::path();
}

// Parts of one run may draw into one folder at the same time; states and their records are one run's alone. `lastOfAll`
// is the last frame of the whole run.
std::vector<pipeline::RunLock> locksOf(const std::string& output, const std::filesystem::path& states,
                                       const RunKeys& keys, std::int64_t lastOfAll, bool keepsStates,
                                       const std::string& scene) {
    const std::string name = fmt::format("taut render {}, process {}", scene, ::getpid());
    std::vector<pipeline::RunLock> locks;
    if (keepsStates) locks.emplace_back(states, pipeline::RunParty{std::nullopt, name});
    if (output.empty() || image::isVideoPath(output)) return locks;
    const std::filesystem::path pictures = image::FramePattern(output).folder();
    std::error_code ignored;
    if (keepsStates && std::filesystem::equivalent(pictures, states, ignored)) return locks;
    core::Hash run;
    run.add(keys.state(lastOfAll));
    run.add(keys.picture);
    locks.emplace_back(pictures, pipeline::RunParty{run.value(), name});
    return locks;
}

ProgressFacts progressFacts(const world::World& world, const pipeline::RunOptions& options, double fps,
                            const pipeline::RecordLog& records) {
    ProgressFacts facts{options.lastFrame + 1, fps, world.tickSeconds(), world.tickSeconds()};
    for (const world::IslandInfo& island : world.islands()) {
        if (island.step > facts.step) continue;
        facts.step = island.step;
        facts.stepLimit = island.stepLimit;
    }
    if (!records.empty())
        if (const pipeline::FrameRecord first = records[0]; first.metrics) facts.firstEnergy = first.metrics->energy();
    return facts;
}

pipeline::RunListener listenerFor(const RenderFlags& flags, const pipeline::RunOptions& options, Progress& progress,
                                  pipeline::Overlay* overlay, int ticksPerFrame) {
    pipeline::RunListener listener;
    if (overlay != nullptr)
        listener.frameSimulated = [overlay, ticksPerFrame](const pipeline::FrameRecord& record) {
            overlay->add({*record.metrics, record.frame * ticksPerFrame});
        };
    const bool everyTick = flags.hashEvery == "tick";
    const bool everyFrame = flags.hash && !everyTick;
    listener.frameDone = [&progress, everyFrame, first = options.firstFrame](const pipeline::FrameRecord& record) {
        if (everyFrame && record.frame >= first) printResult("{} {:016x}\n", record.frame, record.hash);
        progress.frameDone(record);
    };
    if (everyTick)
        listener.tickDone = [](std::int64_t tick, std::uint64_t hash) { printResult("{} {:016x}\n", tick, hash); };
    return listener;
}

void writeWith(const std::filesystem::path& path, const std::function<void(const pipeline::Write&)>& writeAll) {
    core::WholeFile file(path, std::chrono::seconds(10));  // parts of one run may end at the same time
    writeAll([&](std::string_view text) { file.write(text); });
    file.commit();
}

void writeRecords(const image::FrameSink& sink, const RenderFlags& flags,
                  const std::function<void(const pipeline::Write&)>& writeJson, const pipeline::RunResult& result,
                  const std::vector<std::string>& figures) {
    writeWith(sink.companion("run.json"), writeJson);
    if (flags.writesMetrics())
        writeWith(sink.companion("metrics.csv"),
                  [&](const pipeline::Write& write) { pipeline::writeMetricsCsv(write, result, figures); });
}

// What came out, in a line; the first `before` frames are those of an earlier run.
void printSummary(const RenderFlags& flags, const pipeline::RunResult& result, std::size_t before) {
    std::size_t pictures = 0;
    for (std::size_t i = before; i < result.frames.size(); ++i) pictures += result.frames[i].pictured ? 1 : 0;
    const std::size_t simulated = result.frames.size() - before;
    std::string text = fmt::format("{} of {} simulated frames drawn", pictures, simulated);
    if (flags.noPictures) text = fmt::format("{} frames simulated", simulated);
    if (!flags.output.empty()) text += fmt::format(", in {}", flags.output);
    if (!flags.video.empty()) text += fmt::format(" and {}", flags.video);
    printNote("{}, {:.1f} s{}\n", text, result.seconds, result.interrupted ? " (interrupted)" : "");
}

int render(const RenderFlags& flags) {
    checkFlags(flags);
    const scene::Loaded scene = readSceneWithKeys(flags.scene, allOverrides(flags), flags.isConfined);
    const world::SceneSpec& spec = scene.spec;
    pipeline::RunOptions options = runOptions(flags, spec);
    const std::shared_ptr<check::Figures> figures = figuresOf(flags.metricsOf, spec);
    if (figures) {
        options.figures = [figures](const world::World& world) { return figures->of(world); };
        options.figureColumns = columnsOf(figures->names());
    }
    const std::unique_ptr<image::FrameSink> sink = makeOutputs(flags, options, spec.run.fps);
    const Interruption interruption;  // from here on: a question is ended by Ctrl-C as ever
    const std::string large =
        largeRunText(options.lastFrame - options.firstFrame + 1, spec.picture.size.x, spec.picture.size.y);
    if (!large.empty() && !flags.noPictures && !flags.quiet) printNote("note: {}\n", large);
    if (!flags.quiet) notePreparation(spec);
    const core::ThreadLimit threads(flags.threads);
    world::World world(spec, {.threads = flags.threads});
    const std::vector<std::string> foreseen = world.warnings();
    printWarnings(foreseen);

    const std::filesystem::path states = checkpointFolder(flags, sink.get());
    const RunKeys keys = runKeys(scene, lookOf(flags.debug, flags.overlay, flags.layers), world);
    ContinuationFlags continuation = flags.continuation;
    continuation.mayOverwrite = flags.yes;
    const std::string output = flags.noPictures ? "" : flags.output;
    const std::vector<pipeline::RunLock> locks =
        locksOf(output, states, keys, pipeline::frameCount(spec.run) - 1, options.checkpointEvery > 0, flags.scene);
    pipeline::RecordLog records = goOn(continuation, states, keys, output, options, world);
    const std::size_t before = records.size();

    const pipeline::PictureLayers layers = layersOf(flags.layers, world);
    pipeline::Draw draw;
    std::vector<std::unique_ptr<render::Renderer>> renderers;
    if (!flags.noPictures) {
        renderers = makeRenderers(spec.picture, flags.threads, flags.gl, layers,
                                  drawersFor(flags.drawThreads, flags.threads, spec.picture, options));
        std::vector<pipeline::Draw> draws;
        for (const auto& renderer : renderers)
            draws.emplace_back([&renderer](const view::FrameView& view) { return renderer->draw(view); });
        draw = std::move(draws.front());
        options.moreDraws.assign(draws.begin() + 1, draws.end());
    }
    std::unique_ptr<pipeline::Overlay> overlay;
    if (flags.overlay && draw) {
        overlay = std::make_unique<pipeline::Overlay>(fontFile(), pipeline::smallestStep(world));
        for (std::size_t i = 0; i < before; ++i)
            if (const pipeline::FrameRecord record = records[i]; record.metrics)
                overlay->add({*record.metrics, record.frame * world.ticksPerFrame()});
        options.finishPicture = [&](const view::FrameView& view, image::Image& picture) {
            overlay->paint(picture, view.time);
        };
    }

    pipeline::RunResult result;
    {
        Progress progress(progressFacts(world, options, spec.run.fps, records), flags.quiet);
        pipeline::RunListener listener = listenerFor(flags, options, progress, overlay.get(), world.ticksPerFrame());
        if (options.checkpointEvery > 0) keepCheckpoints(states, keys, world, listener);
        result = pipeline::play(world, options, draw, flags.noPictures ? nullptr : sink.get(), listener,
                                interruption.flag(), std::move(records));
    }
    if (sink) {
        const pipeline::RunRequest request{flags.output, allOverrides(flags), flags.threads, options, layers};
        const auto info = renderers.empty() ? std::nullopt : std::optional(renderers.front()->info());
        const auto writeJson = [&](const pipeline::Write& write) {
            pipeline::writeRunJson(write, spec, world, request, pipeline::machine(), info, result);
        };
        writeRecords(*sink, flags, writeJson, result, figures ? figures->names() : std::vector<std::string>{});
    }
    std::vector<std::string> met = world.warnings();  // such as a block squashed flat on the way
    std::erase_if(met, [&](const auto& warning) { return std::ranges::find(foreseen, warning) != foreseen.end(); });
    printWarnings(met);
    if (!flags.quiet) printSummary(flags, result, before);
    if (result.divergence) throw core::Error(core::ErrorKind::diverged, result.divergence->message);
    return static_cast<int>(interruption.exitCode().value_or(ExitCode::ok));
}

void addOutputFlags(Options& options, RenderFlags& flags) {
    options.value("-o,--output", flags.output,
                  "out/frame_######.png, a folder, or a video (.mp4 .mov .mkv .webm .gif)");
    options.value("--video", flags.video, "A video besides the frames of -o").typeName("FILE");
    const Option yes = options.flag("-y,--yes", flags.yes, "Overwrite what exists");
    options.flag("-n,--no", flags.no, "Never overwrite").excludes(yes);
    options.flag("--metrics", flags.metrics, "Write metrics.csv: energy, momentum, strain, contacts of each frame");
    options.value("--metrics-of", flags.metricsOf, "Besides: what these expressions of checks give, to 17 digits")
        .typeName("EXPR,…");
    options.flag("--hash", flags.hash, "Print the state hash of each frame");
    options.value("--hash-every", flags.hashEvery, "Print the state hash of each frame or each tick")
        .oneOf({"frame", "tick"})
        .each([&flags](const std::string&) { flags.hash = true; });
    options.flag("--quiet", flags.quiet, "No progress; warnings and errors only");
}

void addPictureFlags(Options& options, RenderFlags& flags) {
    options.value("--frames", flags.frames, "Draw these frames only: 0-119, 60, or 60-").typeName("A-B");
    options.value("--fps", flags.fps, "Pictures a second of scene time").check(numberWithin(1e-3, 1e6));
    options.value("--seconds", flags.seconds, "Length of scene time").check(numberWithin(leastSeconds, mostSeconds));
    options.value("--size", flags.size, "Size of the pictures in pixels").typeName("WxH");
    options.value("--camera", flags.camera, "Look through this camera of the scene").typeName("NAME");
    options
        .value("--samples", flags.samples,
               "Samples a pixel against jagged edges; 8 and 16 draw each picture two and four times")
        .oneOf({"1", "4", "8", "16"});
    addRendererFlag(options, flags.gl);
    const Option debug = options.flag("--debug", flags.debug, "Show points, springs coloured by strain, and contacts");
    options.flag("--overlay", flags.overlay,
                 "Show time, step and limit, largest strain, contacts between bodies, and the energies as a graph");
    options.flag("--no-pictures", flags.noPictures, "Simulate and draw nothing");
    addLayerFlags(options, flags.layers, debug);
}

Action declareRender(Options& options) {
    const auto flags = std::make_shared<RenderFlags>();
    options.value("SCENE", flags->scene, "A scene file, or the name of a shipped scene").required();
    addOutputFlags(options, *flags);
    addPictureFlags(options, *flags);
    addContinuationFlags(options, flags->continuation);
    options.value("--threads", flags->threads, "Threads to use; all of the machine when not given").within(1, 1024);
    options
        .value("--draw-threads", flags->drawThreads,
               "Pictures drawn at the same time, the same whatever it is; as many as pay here when not given")
        .within(1, 64);
    addInstructionSetFlag(options, flags->isa);
    options.value("--set", flags->overrides, "Override a field: --set cloth.flag.cells=[72,48]; repeatable")
        .typeName("KEY=VALUE")
        .oneValue();
    addConfinedFlag(options, flags->isConfined);
    options.footer(
        "Examples:\n"
        "  taut render flag -o flag.mp4\n"
        "  taut render flag -o out/frame_######.png --size 640x360 --seconds 2\n"
        "  taut render drape -o drape.webm --alpha\n"
        "  taut render show -o out/show --depth --mask\n"
        "  taut render show -o out/show --checkpoint-every 60 --resume\n"
        "  taut render flag -o out/flag --metrics-of \"position(cloth.flag@bottom-right).y,max_strain\"\n"
        "  taut render drape -o late.mp4 --frames 120-179 --set material.linen.bend_N_per_m=4");
    return [flags] { return render(*flags); };
}

}  // namespace

Command renderCommand() {
    return {"render", "Play a scene into picture files or a video", declareRender};
}

}  // namespace taut::game
