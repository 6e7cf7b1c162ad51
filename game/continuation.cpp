#include "game/continuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "game/messages.h"
#include "taut/core/error.h"
#include "taut/core/private/hash.h"
#include "taut/image/frame_sequence.h"
#include "taut/pipeline/checkpoint.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

// The first frame of the run without a picture, or a file beside it, on disk; one past the last when all are there.
std::int64_t firstMissing(const PicturesThere& pictures, const pipeline::RunOptions& options) {
    if (pictures.files.empty()) return options.lastFrame;
    std::int64_t first = options.lastFrame + 1;
    for (const image::FramePattern& each : pictures.files) {
        std::int64_t frame = options.firstFrame;
        for (std::int64_t there : each.framesThere())
            if (there == frame) ++frame;
        first = std::min(first, frame);
    }
    return first;
}

// The largest size of a state of this world, with room for spawned bodies and tears.
std::uint64_t mostBytes(const world::World& world) {
    return 8 * world.save().size() + (std::uint64_t{64} << 20U);
}

// There is nothing else to go on from, and the frames before are of its bits too.
[[noreturn]] void refuseOtherBits(const pipeline::PassedOver& checkpoint, const ContinuationFlags& flags) {
    throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: needs a taut with these bits; {}", checkpoint.why,
                                                                flags.from ? "without --from, -y draws all frames again"
                                                                           : "-y draws all frames again"));
}

}  // namespace

void addContinuationFlags(Options& options, ContinuationFlags& flags) {
    constexpr std::int64_t mostFrames = std::int64_t{1} << 40;
    options.value("--checkpoint-every", flags.every, "Keep the state every so many frames")
        .typeName("FRAMES")
        .within(std::int64_t{1}, mostFrames);
    options.value("--checkpoints", flags.folder, "Folder of states; default `checkpoints` beside the output")
        .typeName("FOLDER");
    options.flag("--resume", flags.resume, "Continue after the last frame on disk, from the last state before it");
    options.value("--from", flags.from, "Draw from this frame on, from the last state before it")
        .typeName("FRAME")
        .within(std::int64_t{0}, mostFrames);
}

std::uint64_t keyOfRun(const RunKeys& keys, std::int64_t lastOfAll) {
    core::Hash run;
    run.add(keys.state(lastOfAll));
    run.add(keys.picture);
    return run.value();
}

RunKeys runKeys(const scene::Loaded& scene, const std::vector<std::uint64_t>& look, const world::World& world) {
    core::Hash steps;  // chosen with an eye on the whole timeline
    for (const world::IslandInfo& island : world.islands()) {
        steps.add(island.name);
        steps.add(island.step);
    }
    core::Hash picture;
    picture.add(scene.keys.picture());
    for (const std::uint64_t each : look) picture.add(each);
    for (const scene::UsedFile& file : scene::pictureFiles(scene.spec)) picture.add(file.content);
    const auto state = [keys = scene.keys, stepsKey = steps.value(),
                        ticks = world.ticksPerFrame()](std::int64_t frame) {
        core::Hash hash;
        hash.add(keys.stateAt(frame * ticks));
        hash.add(stepsKey);
        return hash.value();
    };
    return {state, picture.value(), scene::usedFiles(scene.spec)};
}

pipeline::RecordLog goOn(const ContinuationFlags& flags, const std::filesystem::path& folder, const RunKeys& keys,
                         const PicturesThere& pictures, pipeline::RunOptions& options, world::World& world) {
    const pipeline::CheckpointFolder checkpoints(folder);
    if (flags.every > 0 && !flags.resume && !flags.from && !flags.mayOverwrite && !checkpoints.framesThere().empty())
        throw core::Error(
            core::ErrorKind::inputOutput,
            fmt::format("{} holds states of an earlier run; --resume continues from them, -y starts again",
                        folder.string()));
    // Frames before a kept state are blank.
    const auto fromStart = [&] {
        pipeline::RecordLog log = flags.every > 0 ? pipeline::RecordLog(checkpoints.records(), options.figureColumns)
                                                  : pipeline::RecordLog(options.figureColumns);
        options.startFrame = world.startTick() / world.ticksPerFrame();
        for (std::int64_t frame = 0; frame < options.startFrame; ++frame)
            log.add({.frame = frame, .figures = std::vector<double>(options.figureColumns.count, NAN)});
        return log;
    };
    const bool startsLate = flags.startsLate && !flags.folder.empty() && flags.every == 0;
    if (flags.resume && pictures.areOurs)
        options.firstFrame = std::min(firstMissing(pictures, options), options.lastFrame);
    if (!flags.resume && !flags.from && !startsLate) return fromStart();
    const std::int64_t goal = flags.from     ? *flags.from
                              : flags.resume ? std::min(firstMissing(pictures, options), options.lastFrame)
                                             : options.firstFrame;
    std::vector<pipeline::PassedOver> refused;
    const std::optional<pipeline::Checkpoint> checkpoint =
        checkpoints.latest(goal, keys.state, mostBytes(world), refused);
    for (const pipeline::PassedOver& each : refused) {
        if (each.isOfOtherBits && !checkpoint &&
            (flags.from || (flags.resume && !pictures.areOurs && !flags.mayOverwrite)))
            refuseOtherBits(each, flags);
        printNote("note: {}\n", each.why);
    }
    const bool goesOnWithPictures =
        flags.resume && !pictures.areOurs && !pictures.files.empty() && !pictures.files.front().framesThere().empty();
    if (!checkpoint) {
        if (goesOnWithPictures && !flags.mayOverwrite)
            throw core::Error(core::ErrorKind::inputOutput,
                              fmt::format("{} has no state of this run to continue from, and there are frames already; "
                                          "-y draws all of them again",
                                          folder.string()));
        printNote("note: {} has no state to continue from; starting with frame {}\n", folder.string(),
                  world.startTick() / world.ticksPerFrame());
        return fromStart();
    }
    const bool keepsPictures = checkpoint->frame > options.firstFrame || !flags.mayOverwrite;
    if (goesOnWithPictures && keepsPictures && checkpoint->picture != keys.picture)
        throw core::Error(
            core::ErrorKind::badContent,
            fmt::format("the pictures before frame {} were drawn with another size, camera, light or look; draw all of "
                        "them again with -y and without --resume, or the rest with --from {}",
                        goal, goal));
    world.restore(checkpoint->world);
    printNote("note: continuing with frame {}\n", checkpoint->frame);
    options.startFrame = checkpoint->frame;
    options.firstFrame = std::max(options.firstFrame, options.startFrame);
    const auto before = static_cast<std::size_t>(checkpoint->frame);
    return flags.every > 0 ? pipeline::RecordLog::continuing(checkpoints.records(), before, options.figureColumns)
                           : pipeline::RecordLog::copyOf(checkpoints.records(), before, options.figureColumns);
}

void keepCheckpoints(const std::filesystem::path& folder, const RunKeys& keys, const world::World& world,
                     std::uint64_t records, pipeline::RunListener& listener) {
    const auto keep = [folder, keys](std::int64_t frame, std::vector<std::byte> state, std::uint64_t before) {
        pipeline::writeCheckpoint(pipeline::CheckpointFolder(folder).pathOf(frame),
                                  {frame, keys.state(frame), keys.picture, std::move(state), before, keys.files});
    };
    if (world.tick() == world.startTick()) keep(world.tick() / world.ticksPerFrame(), world.save(), records);
    listener.checkpoint = [keep](std::int64_t frame, std::vector<std::byte> state, const pipeline::RecordLog& before) {
        keep(frame, std::move(state), before.digest());
    };
}

}  // namespace taut::game
