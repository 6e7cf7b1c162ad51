#include "game/frame_join.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <limits>
#include <mutex>
#include <sstream>
#include <thread>

#include "game/live_line.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/whole_file.h"
#include "taut/image/read.h"
#include "taut/pipeline/ordered_handover.h"

namespace taut::game {
namespace {

using pipeline::FrameSpan;
using pipeline::PartRecord;

[[noreturn]] void refuse(const image::FramePattern& pattern, const std::string& why) {
    const std::string folder = pattern.folder().empty() ? "." : pattern.folder().string();
    throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: {}", folder, why));
}

std::string nameOf(const PartRecord& record) {
    return record.path.filename().string();
}

// Compares each with the one that has most states: if it agrees with that, it agrees with the others.
void expectOneRun(const image::FramePattern& pattern, const std::vector<PartRecord>& records) {
    const auto longest = std::ranges::max_element(
        records, [](const PartRecord& a, const PartRecord& b) { return a.hashes.size() < b.hashes.size(); });
    for (const PartRecord& record : records) {
        if (&record == &*longest) continue;
        const std::string difference = pipeline::differenceOf(record, *longest);
        if (!difference.empty())
            refuse(pattern,
                   fmt::format("{} and {} are not parts of one run: {}", nameOf(record), nameOf(*longest), difference));
    }
}

// The frames without a record, and the reason if the records have it.
std::string withoutRecord(const std::vector<PartRecord>& records, const std::vector<FrameSpan>& spans) {
    std::string text = fmt::format("\n  {}: no record of a part that has drawn them", pipeline::inWords(spans));
    for (const PartRecord& record : records) {
        if (record.lastDrawn() >= record.last) continue;
        text += fmt::format(
            "\n  {}: {}", nameOf(record),
            record.ended == "begun"
                ? "has started and not ended"
                : fmt::format("{} {}", record.ended,
                              record.lastDrawn() < record.first ? "before its first frame"
                                                                : fmt::format("after frame {}", record.lastDrawn())));
    }
    return text;
}

void expectAll(const FrameJoin& join) {
    std::string missing;
    const std::vector<FrameSpan> unknown = pipeline::framesWithoutRecord(join.records, join.frames);
    if (!unknown.empty()) missing += withoutRecord(join.records, unknown);
    const auto look = [&](const image::FramePattern& pattern, const std::string& what) {
        const std::vector<FrameSpan> spans = pipeline::framesMissing(pattern.framesThere(), join.frames);
        if (!spans.empty()) missing += fmt::format("\n  {}: no {}", pipeline::inWords(spans), what);
    };
    look(join.pattern, "picture");
    for (const std::string& kind : join.records.front().besides) look(join.pattern.beside(kind), kind);
    if (missing.empty()) return;
    refuse(
        join.pattern,
        fmt::format("frames {}-{} are incomplete:{}\n"
                    "The same --shard K/N --resume draws the missing ones, and so does taut render SCENE --frames A-B",
                    join.frames.first, join.frames.last, missing));
}

// Each is as a record of a part that has drawn it says.
void expectUnchanged(const FrameJoin& join) {
    constexpr std::size_t mostNames = 8;
    const auto sums =
        image::checksumsOf(join.pattern.with(join.records.front().besides), join.frames.first, join.frames.last);
    std::vector<std::string> names;
    for (std::int64_t frame = join.frames.first; frame <= join.frames.last; ++frame) {
        const auto sum = sums[frame - join.frames.first];
        if (std::ranges::none_of(join.records,
                                 [&](const PartRecord& record) { return sum && record.pictureOf(frame) == sum; }))
            names.push_back(join.pattern.pathOf(frame).filename().string());
    }
    if (names.empty()) return;
    const std::size_t count = names.size();
    if (count > mostNames) names.resize(mostNames), names.push_back(fmt::format("{} more", count - mostNames));
    refuse(join.pattern,
           fmt::format("these files differ from their records: damaged, replaced or moved: {}\n"
                       "The same --shard K/N --resume draws them again, and so does taut render SCENE --frames A-B -y",
                       fmt::join(names, ", ")));
}

// Reads pictures ahead, on several threads, and hands them on in order.
class Reading {
  public:
    explicit Reading(const FrameJoin& join)
        : join_(join), next_(join.frames.first), pictures_(2 * static_cast<std::size_t>(core::threadCount())) {
        for (int i = 0; i < core::threadCount(); ++i) workers_.emplace_back([this] { work(); });
    }
    ~Reading() { pictures_.abandon(); }

    // The next one; throws core::Error where it cannot be read.
    image::Image take() {
        std::optional<image::Image> picture = pictures_.take();
        if (!picture) std::rethrow_exception(failure_);
        return std::move(*picture);
    }

  private:
    image::Image read(std::int64_t frame) const {
        const std::filesystem::path path = join_.pattern.pathOf(frame);
        return join_.hasAlpha() ? image::readImageWithAlpha(path) : image::readImage(path);
    }

    void work() {
        for (std::int64_t frame = next_++; frame <= join_.frames.last; frame = next_++) {
            try {
                if (!pictures_.put(frame - join_.frames.first, read(frame))) return;
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (frame < failed_) failure_ = std::current_exception();
                failed_ = std::min(failed_, frame);
                pictures_.endAt(frame - join_.frames.first);
                return;
            }
        }
    }

    const FrameJoin& join_;
    std::atomic<std::int64_t> next_;
    pipeline::OrderedHandover<image::Image> pictures_;
    std::mutex mutex_;
    std::exception_ptr failure_;
    std::int64_t failed_ = std::numeric_limits<std::int64_t>::max();
    std::vector<std::jthread> workers_;  // last: they end before the data they use
};

// Another run that has failed before its first picture has left none of the parts.
void leaveOutFailed(std::vector<PartRecord>& records) {
    const auto hasDrawn = [](const PartRecord& record) { return record.lastDrawn() >= record.first; };
    const auto drawn = std::ranges::find_if(records, hasDrawn);
    if (drawn == records.end()) return;
    std::erase_if(records, [&, run = std::pair(drawn->key, drawn->count)](const PartRecord& record) {
        return !hasDrawn(record) && std::pair(record.key, record.count) != run;
    });
}

[[noreturn]] void refuseWithoutRecord(const image::FramePattern& pattern) {
    const std::vector<std::string> others = pipeline::recordedFiles(pattern.folder());
    if (others.empty())
        refuse(pattern, "there is no record of pictures, run.json or run_0-119.json: nothing was drawn here");
    refuse(pattern, fmt::format("no record describes files {}, but {}: taut join {}", pattern.name(),
                                fmt::join(others, " and "), (pattern.folder() / others.front()).string()));
}

}  // namespace

FrameJoin provedFrames(const image::FramePattern& pattern, const std::optional<FrameRange>& wanted) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(pattern.folder().empty() ? "." : pattern.folder(), ignored))
        refuse(pattern, "there is no such folder");
    FrameJoin join{pattern, pipeline::partRecords(pattern), {}};
    for (const PartRecord& record : join.records)
        if (!record.fault.empty()) throw core::Error(core::ErrorKind::badContent, record.fault);
    if (join.records.empty()) refuseWithoutRecord(pattern);
    leaveOutFailed(join.records);
    expectOneRun(pattern, join.records);
    const std::int64_t count = join.records.front().count;
    const FrameRange range = wanted.value_or(FrameRange{});
    join.frames = {range.first, range.last.value_or(count - 1)};
    if (join.frames.last >= count || join.frames.first >= count)
        failUsage("--frames: the run has frames 0-{}", count - 1);
    expectAll(join);
    expectUnchanged(join);
    return join;
}

JoinedMetrics joinedMetrics(const FrameJoin& join) {
    constexpr std::uint64_t mostBytes = std::uint64_t{1} << 32U;
    std::string all, heading, from, without;
    std::int64_t next = 0;
    for (const PartRecord& record : join.records) {
        if (next > join.frames.last) break;
        // run_0-119.json: metrics_0-119.csv
        const std::string name = "metrics" + record.path.stem().string().substr(3) + ".csv";
        const std::filesystem::path path = record.path.parent_path() / name;
        if (record.lastDrawn() < std::max(next, record.first)) continue;
        if (!core::isThere(path)) {
            if (without.empty()) without = name;
            continue;
        }
        std::istringstream lines(core::fileContent(path, mostBytes));
        std::string line;
        std::getline(lines, line);
        if (heading.empty()) {
            all = heading = line;
            from = name;
        }
        if (line != heading) return {"", fmt::format("{} and {} have other columns", from, name)};
        const std::int64_t last = std::min(record.lastDrawn(), join.frames.last);
        while (std::getline(lines, line)) {
            const std::int64_t frame = std::strtoll(line.c_str(), nullptr, 10);
            if (frame >= next && frame <= last) all += "\n" + line;
        }
        next = last + 1;
    }
    if (from.empty()) return {};
    if (!without.empty()) return {"", fmt::format("{} is there, and no {}", from, without)};
    return {all + "\n", ""};
}

bool encodeFrames(const FrameJoin& join, image::FrameSink& sink, bool quiet, const std::atomic<bool>& stop) {
    Reading reading(join);
    LiveLine line(quiet);
    const std::int64_t count = join.frames.last - join.frames.first + 1;
    for (std::int64_t frame = join.frames.first; frame <= join.frames.last; ++frame) {
        if (stop) return false;
        sink.write(frame, reading.take());
        const std::int64_t done = frame - join.frames.first + 1;
        if (line.isDue(done == count)) line.show(fmt::format("encoding {} of {} frames", done, count));
    }
    if (stop) return false;
    sink.finish();
    return true;
}

}  // namespace taut::game
