#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/continuation.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/interruption.h"
#include "game/layer_flags.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/progress.h"
#include "game/render_flags.h"
#include "game/render_outputs.h"
#include "game/render_stills.h"
#include "game/renderers.h"
#include "game/run_part.h"
#include "game/scene_file.h"
#include "game/tables.h"
#include "game/usage.h"
#include "taut/check/figures.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/hash.h"
#include "taut/core/private/parallel.h"
#include "taut/core/whole_file.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/private/video_writer.h"
#include "taut/pipeline/overlay.h"
#include "taut/pipeline/run.h"
#include "taut/pipeline/run_lock.h"
#include "taut/pipeline/run_parts.h"
#include "taut/pipeline/run_record.h"
#include "taut/pipeline/saved_state.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

pipeline::RunOptions runOptions(const RenderFlags& flags, const RunPart& part, const world::SceneSpec& spec) {
    pipeline::RunOptions options;
    options.firstFrame = part.frames.first;
    options.lastFrame = part.frames.last;
    options.debugView = flags.debug;
    expose(flags.layers, spec, flags.threads, options);
    options.checkpointEvery = flags.continuation.every;
    // Who goes on from a checkpoint may want the figures of the frames before it.
    options.metrics = flags.writesMetrics() || flags.overlay || !flags.quiet || options.checkpointEvery > 0;
    return options;
}

// The figures of --metrics-of, or null.
std::shared_ptr<check::Figures> figuresOf(const std::string& text, const world::SceneSpec& spec) {
    if (text.empty()) return nullptr;
    const auto fail = [](const std::string& message) { failUsage("--metrics-of: {}", message); };
    try {
        auto figures = std::make_shared<check::Figures>(check::Figures::parse(text));
        for (const check::Mention& mention : figures->mentions())
            if (const std::string fault =
                    mention.isJoint ? scene::jointFault(spec, mention.target)
                                    : scene::targetFault(spec, mention.target, mention.hasPoints, mention.against);
                !fault.empty())
                fail(fault);
        return figures;
    } catch (const check::ClaimError& fault) {
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

// The names of the further measures.
std::vector<std::string> addFigures(const std::string& text, const world::SceneSpec& spec,
                                    pipeline::RunOptions& options) {
    const std::shared_ptr<check::Figures> figures = figuresOf(text, spec);
    if (!figures) return {};
    options.figures = [figures](const world::World& world) { return figures->of(world); };
    options.figureColumns = columnsOf(figures->names());
    return figures->names();
}

// Parts of one run may draw into one folder at the same time; states and their records are one run's alone.
std::vector<pipeline::RunLock> locksOf(const RenderFlags& flags, const RunPart& part,
                                       const std::optional<PartPlace>& place, const std::filesystem::path& states) {
    const std::string name =
        pipeline::partyName(fmt::format("taut render {}{}{}", flags.scene, part.title.empty() ? "" : " ", part.title));
    const bool keepsStates = flags.continuation.every > 0;
    std::vector<pipeline::RunLock> locks;
    if (keepsStates) locks.emplace_back(states, pipeline::RunParty{std::nullopt, name});
    std::error_code ignored;
    if (!place || (keepsStates && std::filesystem::equivalent(place->pattern.folder(), states, ignored))) return locks;
    std::ranges::move(lockPart(part, *place, name), std::back_inserter(locks));
    return locks;
}

// Where frames lie that are drawn; none where there are none.
bool drawsFrames(const RenderFlags& flags) {
    return !flags.noPictures && !flags.output.empty() && !image::isVideoPath(flags.output);
}

std::optional<PartPlace> placeOf(const RenderFlags& flags, std::uint64_t key) {
    if (!drawsFrames(flags)) return std::nullopt;
    return PartPlace{framePattern(flags), filesBeside(flags.layers), key, flags.continuation.resume,
                     flags.overwrite.yes};
}

ProgressFacts progressFacts(const world::World& world, const pipeline::RunOptions& options, double fps,
                            const pipeline::RecordLog& records) {
    ProgressFacts facts{options.lastFrame + 1, fps, pipeline::smallestStep(world)};
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

// The result, in a line; the first `before` frames are those of an earlier run.
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

// The renderers of a run, and the functions that draw with them.
struct Drawing {
    pipeline::PictureLayers layers;
    std::vector<std::unique_ptr<render::Renderer>> renderers;
    pipeline::Draw draw;  // null: nothing is drawn
    std::optional<render::RendererInfo> info;
    std::unique_ptr<pipeline::Overlay> overlay;
};

Drawing makeDrawing(const RenderFlags& flags, const world::World& world, const world::PictureSpec& picture,
                    pipeline::RunOptions& options) {
    Drawing drawing;
    drawing.layers = layersOf(flags.layers, world);
    if (flags.noPictures) return drawing;
    drawing.renderers =
        makeRenderers(picture, flags.threads, flags.gl, drawing.layers, drawersFor(flags.threads, picture, options));
    drawing.info = drawing.renderers.front()->info();
    std::vector<pipeline::Draw> draws;
    for (const auto& each : drawing.renderers)
        draws.emplace_back([renderer = each.get()](const view::FrameView& view) { return renderer->draw(view); });
    drawing.draw = std::move(draws.front());
    options.moreDraws.assign(draws.begin() + 1, draws.end());
    return drawing;
}

// The figures of the frames before the simulated ones.
void addOverlay(const world::World& world, const pipeline::RecordLog& before, pipeline::RunOptions& options,
                Drawing& drawing) {
    drawing.overlay = std::make_unique<pipeline::Overlay>(fontFile(), pipeline::smallestStep(world));
    for (std::size_t i = 0; i < before.size(); ++i)
        if (const pipeline::FrameRecord record = before[i]; record.metrics)
            drawing.overlay->add({*record.metrics, record.frame * world.ticksPerFrame()});
    options.finishPicture = [overlay = drawing.overlay.get()](const view::FrameView& view, image::Image& picture) {
        overlay->paint(picture, view.time);
    };
}

// Shows progress meanwhile; `prepare` may add listeners.
pipeline::RunResult playRun(const RenderFlags& flags, const pipeline::RunOptions& options, const Drawing& drawing,
                            image::FrameSink* sink, pipeline::RecordLog records, world::World& world, double fps,
                            const std::function<void(pipeline::RunListener&)>& prepare, const std::atomic<bool>& stop) {
    Progress progress(progressFacts(world, options, fps, records), flags.quiet);
    pipeline::RunListener listener =
        listenerFor(flags, options, progress, drawing.overlay.get(), world.ticksPerFrame());
    prepare(listener);
    try {
        return pipeline::play(world, options, drawing.draw, drawing.draw ? sink : nullptr, listener, stop,
                              std::move(records));
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::inputOutput || !drawsFrames(flags) || !flags.video.empty()) throw;
        throw core::Error(error.kind(), std::string(error.what()) + "; the same with --resume then goes on");
    }
}

// The messages before the run.
void noteWhatIsAhead(const RenderFlags& flags, const RunPart& part, const world::SceneSpec& spec) {
    if (flags.quiet) return;
    const std::string large =
        largeRunText(part.frames.last - part.frames.first + 1, spec.picture.size.x, spec.picture.size.y);
    if (!large.empty() && !flags.noPictures) printNote("note: {}\n", large);
    notePreparation(spec);
}

// Warnings of the run, such as a block squashed flat.
void warnOfNew(const std::vector<core::Finding>& foreseen, std::vector<core::Finding> met) {
    std::erase_if(met, [&](const auto& warning) { return core::contains(foreseen, warning); });
    printWarnings(met);
}

// From which scenes start by `run.start`.
void keepLastState(const RenderFlags& flags, const scene::Loaded& scene, const world::World& world) {
    std::error_code ignored;
    pipeline::SavedState state;
    state.source.file = std::filesystem::weakly_canonical(scene.spec.file, ignored).string();
    state.source.overrides = allOverrides(flags);
    state.source.isConfined = flags.isConfined;
    state.key = scene.keys.stateAt(world.tick());
    state.tick = world.tick();
    state.files = scene::usedFiles(scene.spec);
    state.world = world.save();
    core::writeWholeFile(flags.state, pipeline::toBytes(state));
}

// Over 60 lines: the steps of a run, from its flags to its files, are one list.
int render(const RenderFlags& flags) {
    checkFlags(flags);
    if (!flags.at.empty()) return renderStills(flags);
    const scene::Loaded scene = readSceneWithKeys(flags.scene, allOverrides(flags), flags.isConfined);
    const world::SceneSpec& spec = scene.spec;
    const RunPart part = partOf(flags, spec.run);
    pipeline::RunOptions options = runOptions(flags, part, spec);
    const std::vector<std::string> figures = addFigures(flags.metricsOf, spec, options);
    const std::unique_ptr<image::FrameSink> sink = makeOutputs(flags, part, spec.run.fps);
    if (!flags.state.empty()) {
        permitOverwritingFile(flags.state, flags.overwrite.answer());
        core::prepareFolderOf(flags.state);
    }
    const Interruption interruption;  // from here on: a question is ended by Ctrl-C as ever
    noteWhatIsAhead(flags, part, spec);
    const core::ThreadLimit threads(flags.threads);
    world::World world(spec, {.threads = flags.threads});
    const std::vector<core::Finding> foreseen = world.warnings();
    printWarnings(foreseen);

    const std::filesystem::path states = checkpointFolder(flags);
    const RunKeys keys = runKeys(scene, lookOf(flags.debug, flags.overlay, flags.layers), world);
    const std::uint64_t key = keyOfRun(keys, part.count - 1);
    const std::optional<PartPlace> place = placeOf(flags, key);
    const std::vector<pipeline::RunLock> locks = locksOf(flags, part, place, states);
    noteMissingLocks(locks);
    Drawing drawing = makeDrawing(flags, world, spec.picture, options);
    pipeline::RunRequest request{flags.output, allOverrides(flags), flags.threads, options, drawing.layers,
                                 key,          part.frames.first,   part.count,    true};
    const auto writeJson = [&](const pipeline::RunResult& result) {
        return [&](const pipeline::Write& write) {
            pipeline::writeRunJson(write, spec, world, request, pipeline::machine(), drawing.info, result);
        };
    };
    const PartState state = place ? claimPart(part, *place, pipeline::rendererText(drawing.info)) : PartState::fresh;
    if (state == PartState::complete) {
        printNote("{}: frames {}-{} are there already, in {}\n", part.title, part.frames.first, part.frames.last,
                  flags.output);
        return static_cast<int>(ExitCode::ok);
    }
    if (part.isShared) writeWith(recordPath(flags, part, "run", ".json"), writeJson({}));
    const PicturesThere pictures{place ? place->files() : std::vector<image::FramePattern>(),
                                 state == PartState::begun};
    ContinuationFlags continuation = flags.continuation;
    continuation.mayOverwrite = flags.overwrite.yes;
    continuation.startsLate = !part.title.empty();
    pipeline::RecordLog records = goOn(continuation, states, keys, pictures, options, world);
    const std::size_t before = records.size();
    const auto keepingStates = [&, digest = records.digest()](pipeline::RunListener& listener) {
        if (options.checkpointEvery > 0) keepCheckpoints(states, keys, world, digest, listener);
    };
    if (flags.overlay && drawing.draw) addOverlay(world, records, options, drawing);

    const pipeline::RunResult result = playRun(flags, options, drawing, sink.get(), std::move(records), world,
                                               spec.run.fps, keepingStates, interruption.flag());
    if (!flags.output.empty()) {
        request.options = options;
        request.isBegun = false;
        const auto known = static_cast<std::int64_t>(result.frames.size());
        if (place) request.pictures = place->checksums({part.frames.first, std::min(part.frames.last, known - 1)});
        writeRecords(flags, part, writeJson(result), spec, result, figures);
    }
    if (!flags.state.empty() && !result.divergence && !result.interrupted) keepLastState(flags, scene, world);
    warnOfNew(foreseen, world.warnings());
    if (!flags.quiet) printSummary(flags, result, before);
    if (result.divergence) throw core::Error(core::ErrorKind::diverged, result.divergence->message);
    return static_cast<int>(interruption.exitCode().value_or(ExitCode::ok));
}

Action declareRender(Options& options, const render::LayerKinds& layers) {
    const auto flags = std::make_shared<RenderFlags>();
    flags->layers.layers = flagsOf(layers);
    addRenderFlags(options, *flags);
    return [flags] {
        completeFlags(*flags);
        return render(*flags);
    };
}

}  // namespace

Command renderCommand(const Tables& tables) {
    return {"render", "Render a scene to pictures or a video",
            [layers = tables.layers](Options& options) { return declareRender(options, layers); }};
}

}  // namespace taut::game
