#include "game/run_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "game/flags.h"
#include "game/messages.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/image/private/video_writer.h"
#include "taut/pipeline/machine.h"
#include "taut/pipeline/run.h"
#include "taut/spec/ticks.h"

namespace taut::game {
namespace {

bool overlap(const pipeline::PartRecord& record, const pipeline::FrameSpan& frames) {
    return record.first <= frames.last && record.last >= frames.first;
}

void removeFile(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error)
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: cannot be removed: {}", path.string(), error.message()));
}

void removeFrames(const PartPlace& place, const pipeline::FrameSpan& frames) {
    for (const image::FramePattern& pattern : place.files())
        for (const std::int64_t frame : pattern.framesThere())
            if (frame >= frames.first && frame <= frames.last) removeFile(pattern.pathOf(frame));
}

std::vector<std::int64_t> framesThere(const PartPlace& place, const pipeline::FrameSpan& frames) {
    std::vector<std::int64_t> there = place.pattern.framesThere();
    std::erase_if(there, [&](std::int64_t frame) { return frame < frames.first || frame > frames.last; });
    return there;
}

// Frames that differ from their record: the part draws them again.
void removeChanged(const PartPlace& place, const pipeline::PartRecord& own) {
    const auto there = image::checksumsOf(place.files(), own.first, own.lastDrawn());
    for (std::int64_t frame = own.first; frame <= own.lastDrawn(); ++frame) {
        const auto sum = there[frame - own.first];
        if (!sum || sum == own.pictureOf(frame).value_or(*sum)) continue;
        printNote("note: {} differs from its record: it is drawn again\n", place.pattern.pathOf(frame).string());
        removeFrames(place, {frame, frame});
    }
}

bool hasAllFrames(const RunPart& part, const PartPlace& place) {
    const std::vector<image::FramePattern> patterns = place.files();
    return std::ranges::all_of(patterns, [&](const image::FramePattern& pattern) {
        return pipeline::framesMissing(pattern.framesThere(), part.frames).empty();
    });
}

// A run that has the folder for itself: records of others about the frames that it replaces are outdated.
void takeAwayRecords(const RunPart& part, const std::vector<pipeline::PartRecord>& records) {
    for (const pipeline::PartRecord& record : records)
        if (record.fault.empty() && overlap(record, part.frames)) removeFile(record.path);
}

bool isOfRun(const pipeline::PartRecord& record, const RunPart& part, const PartPlace& place) {
    return record.key == pipeline::hexadecimal(place.key) && record.count == part.count;
}

// Failed before its first picture. Who draws another run holds the lock of the folder: it is at work no more.
bool hasLeftNothing(const pipeline::PartRecord& record, const PartPlace& place) {
    return record.fault.empty() && record.lastDrawn() < record.first &&
           framesThere(place, {record.first, record.last}).empty();
}

void refuseOtherRuns(const RunPart& part, const PartPlace& place, const std::vector<pipeline::PartRecord>& records) {
    for (const pipeline::PartRecord& record : records) {
        if (isOfRun(record, part, place)) continue;
        if (!place.mayOverwrite && !hasLeftNothing(record, place)) {
            const std::string other =
                record.key == pipeline::hexadecimal(place.key)
                    ? fmt::format("a run of {} frames, and this one has {}", record.count, part.count)
                    : fmt::format("another run{}", record.fault.empty() ? "" : ", or of none");
            throw core::Error(
                core::ErrorKind::inputOutput,
                fmt::format("{} is of {}: use another folder; -y overwrites it", record.path.string(), other));
        }
        removeFile(record.path);
    }
}

}  // namespace

std::vector<std::uint32_t> PartPlace::checksums(const pipeline::FrameSpan& frames) const {
    std::vector<std::uint32_t> sums;
    for (const auto& sum : image::checksumsOf(files(), frames.first, frames.last)) sums.push_back(sum.value_or(0));
    return sums;
}

std::string RunPart::companion(const std::string& stem, const std::string& extension) const {
    return isShared ? pipeline::partName(frames.first, frames.last, stem, extension) : stem + extension;
}

RunPart partOf(const RenderFlags& flags, const world::RunSpec& run) {
    RunPart part;
    part.count = pipeline::frameCount(run);
    const std::int64_t first = world::Ticks(run).firstFrame;
    FrameRange range = flags.frames.empty() ? FrameRange{first, {}} : frameRange(flags.frames);
    if (flags.continuation.from) range.first = *flags.continuation.from;
    part.frames = {range.first, range.last.value_or(part.count - 1)};
    if (part.frames.first >= part.count || part.frames.last >= part.count)
        failUsage("{}: the scene has frames 0-{}; --seconds makes it longer",
                  flags.frames.empty() ? fmt::format("--from {}", range.first) : "--frames " + flags.frames,
                  part.count - 1);
    if (part.frames.first < first)
        failUsage("{}: the scene starts with frame {}, from {}",
                  flags.frames.empty() ? fmt::format("--from {}", range.first) : "--frames " + flags.frames, first,
                  run.start);
    if (!flags.frames.empty()) part.title = "--frames " + flags.frames;
    if (!flags.shard.empty()) {
        const Shard piece = shard(flags.shard);
        const std::int64_t begin = part.frames.first, frames = part.frames.last - begin + 1;
        if (piece.count > frames)
            failUsage("--shard {}: {} frame{} cannot be divided into {}", flags.shard, frames, frames == 1 ? "" : "s",
                      piece.count);
        part.frames = {begin + piece.begin(frames), begin + piece.end(frames) - 1};
        part.title = "--shard " + flags.shard;
    }
    part.isShared =
        !part.title.empty() && !flags.noPictures && !flags.output.empty() && !image::isVideoPath(flags.output);
    return part;
}

void noteMissingLocks(const std::vector<pipeline::RunLock>& locks) {
    const auto open = std::ranges::find_if(locks, [](const auto& lock) { return !lock.excludesOthers(); });
    if (open == locks.end()) return;
    printNote("note: {} has no locks: let no two runs, and no two of the same shard, write there\n",
              open->folder().string());
}

std::vector<pipeline::RunLock> lockPart(const RunPart& part, const PartPlace& place, const std::string& name) {
    std::vector<pipeline::RunLock> locks;
    const std::filesystem::path& folder = place.pattern.folder();
    locks.emplace_back(folder, pipeline::RunParty{place.key, name});
    if (part.isShared)
        locks.emplace_back(folder, pipeline::RunParty{std::nullopt, name},
                           fmt::format("{}-{}", part.frames.first, part.frames.last));
    return locks;
}

PartState claimPart(const RunPart& part, const PartPlace& place, const std::string& renderer) {
    const std::vector<pipeline::PartRecord> records = pipeline::partRecords(place.pattern);
    if (part.isShared) refuseOtherRuns(part, place, records);
    const std::string name = part.companion("run", ".json");
    const auto own = std::ranges::find_if(records, [&](const pipeline::PartRecord& record) {
        return record.path.filename() == name && isOfRun(record, part, place);
    });
    const bool goesOn = own != records.end() && place.resumes;
    if (goesOn) removeChanged(place, *own);
    if (!part.isShared) {
        if (!place.resumes) takeAwayRecords(part, records);
        return PartState::fresh;
    }
    if (goesOn && own->ended == "complete" && own->pictureOf(part.frames.last) && hasAllFrames(part, place))
        return PartState::complete;
    const std::vector<std::int64_t> there = framesThere(place, part.frames);
    if (own == records.end() && place.resumes && !place.mayOverwrite && !there.empty())
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{} is there, without a record in {}; -y draws it again",
                                      place.pattern.pathOf(there.front()).string(), name));
    const std::string program = pipeline::machine().program;
    const auto isAlike = [&](const pipeline::PartRecord& record) {
        return record.renderer == renderer && record.program == program;
    };
    for (const pipeline::PartRecord& record : records)
        if (overlap(record, part.frames) && !isAlike(record) && core::isThere(record.path)) removeFile(record.path);
    if (goesOn && isAlike(*own)) return PartState::begun;
    if (goesOn) {
        const bool isRenderer = own->renderer != renderer;
        printNote("note: frames {}-{} were begun by {}: all of them are drawn again by {}\n", part.frames.first,
                  part.frames.last, isRenderer ? own->renderer : own->program, isRenderer ? renderer : program);
    }
    if (own != records.end()) removeFile(own->path);
    removeFrames(place, part.frames);
    return PartState::begun;
}

}  // namespace taut::game
