#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/frame_join.h"
#include "game/interruption.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/render_outputs.h"
#include "game/test_outcome.h"
#include "game/test_shards.h"
#include "game/usage.h"
#include "taut/core/private/stopwatch.h"
#include "taut/core/whole_file.h"
#include "taut/image/private/video_writer.h"

namespace taut::game {
namespace {

struct JoinFlags {
    std::string place, output, frames, junit;
    OverwriteFlags overwrite;
    bool quiet = false;
};

// The record of the whole run, and its metrics where all parts have theirs.
void writeJoinedRecords(const FrameJoin& join, const image::FrameSink& sink) {
    writeWith(sink.companion("run.json"),
              [&](const pipeline::Write& write) { pipeline::writeJoinedJson(write, join.records, join.frames); });
    const JoinedMetrics metrics = joinedMetrics(join);
    if (!metrics.text.empty()) core::writeWholeFile(sink.companion("metrics.csv"), metrics.text);
    if (!metrics.fault.empty()) printNote("note: metrics are not joined: {}\n", metrics.fault);
}

int joinFrames(const JoinFlags& flags) {
    const core::Stopwatch watch;
    if (!flags.output.empty() && !image::isVideoPath(flags.output))
        failUsage("-o {}: frames are joined to a video: .mp4 .mov .mkv .webm .gif", flags.output);
    const std::optional<FrameRange> wanted =
        flags.frames.empty() ? std::nullopt : std::optional(frameRange(flags.frames));
    const FrameJoin join = provedFrames(image::FramePattern(flags.place), wanted);
    const std::string proved = fmt::format("frames {}-{} of one run, in {} part{}", join.frames.first, join.frames.last,
                                           join.records.size(), join.records.size() == 1 ? "" : "s");
    if (flags.output.empty()) {
        printResult("{}: {}\n", flags.place, proved);
        return static_cast<int>(ExitCode::ok);
    }
    if (join.hasAlpha() && !image::mayHaveAlpha(flags.output))
        failUsage("{}: these frames are transparent, which .webm and .mov can be", flags.output);
    permitOverwritingFile(flags.output, flags.overwrite.answer());
    const std::unique_ptr<image::FrameSink> sink = makeVideo(flags.output, join.fps(), join.hasAlpha());
    const Interruption interruption;
    if (encodeFrames(join, *sink, flags.quiet, interruption.flag())) {
        writeJoinedRecords(join, *sink);
        if (!flags.quiet) printNote("{}, in {}, {:.1f} s\n", proved, flags.output, watch.seconds());
    }
    return static_cast<int>(interruption.exitCode().value_or(ExitCode::ok));
}

// The report of all shards, with the exit code that taut test has for it.
int joinTests(const JoinFlags& flags) {
    if (!flags.frames.empty()) failUsage("--frames applies to frames; this folder has shards of taut test");
    const std::filesystem::path folder = flags.output.empty() ? flags.place : flags.output;
    if (image::isVideoPath(folder))
        failUsage("-o {}: shards of taut test become a report: -o FOLDER, or without -o where they are", flags.output);
    TestShard all = joinedShards(flags.place);
    core::prepareFolderOf(pageIn(folder));
    if (!flags.junit.empty()) core::prepareFolderOf(flags.junit);
    addAcceptance(all.accepts, all.report);
    showOutcome(all.report, folder);
    writeReport(all.report, folder, flags.junit);
    return exitCodeOf(all);
}

int join(const JoinFlags& flags) {
    const bool hasTests = hasTestShards(flags.place);
    if (hasTests && !pipeline::partRecords(image::FramePattern(flags.place)).empty())
        failUsage("{}: there are shards of taut test and of taut render; move one of them elsewhere", flags.place);
    if (!hasTests && !flags.junit.empty()) failUsage("--junit applies to shards of taut test");
    return hasTests ? joinTests(flags) : joinFrames(flags);
}

Action declareJoin(Options& options) {
    const auto flags = std::make_shared<JoinFlags>();
    options.value("FOLDER", flags->place, "Folder of the shards, or the names of the frames: out/f_######.png")
        .required();
    options.value("-o,--output", flags->output,
                  "Video to make (.mp4 .mov .mkv .webm .gif), default none; of tests the folder of the report");
    options.value("--junit", flags->junit, "Of tests: also write the results as JUnit XML").typeName("FILE");
    options.value("--frames", flags->frames, "Frames to join: 0-119, 60, or 60-").typeName("A-B");
    addOverwriteFlags(options, flags->overwrite);
    options.flag("--quiet", flags->quiet, "Print no progress");
    options.footer(
        "Examples:\n"
        "  taut join out/show                    verify that all frames are there, and of one run\n"
        "  taut join out/show -o show.mp4        then encode the video that taut render -o show.mp4 makes\n"
        "  taut join out/test                    write the report of all shards of taut test, with its exit code\n"
        "Missing and differing frames are named, and the exit code is 6.");
    return withThreads(options, [flags] { return join(*flags); });
}

}  // namespace

Command joinCommand() {
    return {"join", "Verify shards and make their video or report", declareJoin};
}

}  // namespace taut::game
