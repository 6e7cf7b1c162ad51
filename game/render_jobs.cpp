#include "game/render_jobs.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "game/exit_code.h"
#include "game/frame_join.h"
#include "game/live_line.h"
#include "taut/core/private/child_process.h"
#include "taut/core/error.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/private/video_writer.h"

namespace taut::game {
namespace {

using Clock = std::chrono::steady_clock;
constexpr const char* starterVariable = "TAUT_STARTED_BY";

// Beside a video ".show.mp4.taut-jobs", in a folder of frames ".taut-jobs".
std::filesystem::path folderFor(const std::filesystem::path& output) {
    if (image::isVideoPath(output)) return output.parent_path() / ("." + output.filename().string() + ".taut-jobs");
    return image::FramePattern(output).folder() / ".taut-jobs";
}

void addLook(const RenderFlags& flags, std::vector<std::string>& words) {
    const auto addFlag = [&](bool isGiven, const char* name) {
        if (isGiven) words.emplace_back(name);
    };
    const auto addText = [&](const std::string& value, const char* name) {
        if (!value.empty()) words.insert(words.end(), {name, value});
    };
    const auto addNumber = [&](double value, const char* name) {
        if (value > 0.0) words.insert(words.end(), {name, fmt::format("{}", value)});
    };
    addText(flags.size, "--size");
    addText(flags.camera, "--camera");
    addText(flags.gl, "--gl");
    addText(flags.isa, "--isa");
    addNumber(flags.fps, "--fps");
    addNumber(flags.seconds, "--seconds");
    addNumber(flags.samples, "--samples");
    addNumber(flags.drawThreads, "--draw-threads");
    addNumber(flags.layers.blurMoments, "--motion-blur");
    addNumber(flags.layers.fStop, "--f-stop");
    addNumber(flags.layers.focus, "--focus");
    addFlag(flags.debug, "--debug");
    addFlag(flags.overlay, "--overlay");
    addFlag(flags.layers.alpha, "--alpha");
    for (const LayerFlag& layer : flags.layers.layers) {
        if (!layer.isGiven) continue;
        words.push_back("--" + layer.kind.name);
        if (layer.kind.number)
            words.insert(words.end(), {"--" + layer.kind.number->name, fmt::format("{}", layer.number)});
    }
    addFlag(flags.isConfined, "--confined");
    for (const std::string& text : flags.overrides) words.insert(words.end(), {"--set", text});
}

core::ChildCommand commandOf(const RenderFlags& flags, const JobsFolder& folder, const Shard& piece) {
    const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const int threads = std::max(1, (flags.threads > 0 ? flags.threads : machine) / static_cast<int>(piece.count));
    core::ChildCommand command;
    command.arguments = {std::filesystem::read_symlink("/proc/self/exe").string(),
                         "render",
                         flags.scene,
                         "-o",
                         folder.frames().string(),
                         "--shard",
                         piece.text(),
                         "--checkpoints",
                         folder.states().string(),
                         "--threads",
                         std::to_string(threads),
                         "--quiet",
                         "-y"};
    if (!flags.frames.empty()) command.arguments.insert(command.arguments.end(), {"--frames", flags.frames});
    addLook(flags, command.arguments);
    command.environment[starterVariable] = std::to_string(::getpid());
    command.patience = std::chrono::hours(24 * 365);
    return command;
}

// What a shard said besides notes.
std::string complaintOf(const core::ChildProcess& child) {
    std::istringstream lines(child.errors());
    std::string text;
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("note: ")) text += "\n" + line;
    return text;
}

core::ErrorKind kindOf(const core::ChildEnd& end) {
    using core::ErrorKind;
    for (const ErrorKind kind : {ErrorKind::usage, ErrorKind::badContent, ErrorKind::diverged, ErrorKind::noRenderer})
        if (end.code == static_cast<int>(exitCodeOf(kind))) return kind;
    return ErrorKind::inputOutput;
}

// The processes of the shards; those that still run when it goes are asked to end, and waited for.
class Jobs {
  public:
    Jobs(const RenderFlags& flags, const JobsFolder& folder, std::int64_t count) : count_(count) {
        for (std::int64_t i = 0; i < count; ++i)
            children_.push_back(std::make_unique<core::ChildProcess>(commandOf(flags, folder, {i, count})));
    }
    ~Jobs() {
        for (const auto& child : children_) child->askToEnd();
        const auto start = Clock::now();  // they end with the picture that they have in hand
        while (Clock::now() - start < std::chrono::minutes(1) && areRunning()) pause();
    }
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    bool areRunning() {
        return std::any_of(
            children_.begin(), children_.end(), [](const auto& child) { return child->isRunning(); });
    }
    static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

    // Throws what the first that has failed said.
    void expectSuccess() {
        for (std::size_t i = 0; i < children_.size(); ++i) {
            if (children_[i]->isRunning()) continue;
            const core::ChildEnd end = children_[i]->wait();
            if (end.succeeded()) continue;
            throw core::Error(kindOf(end),
                              fmt::format("shard {}/{} {}{}", i, count_, end.text(), complaintOf(*children_[i])));
        }
    }

  private:
    std::int64_t count_;
    std::vector<std::unique_ptr<core::ChildProcess>> children_;
};

std::int64_t drawnOf(const image::FramePattern& pattern, const pipeline::FrameSpan& frames) {
    const std::vector<std::int64_t> there = pattern.framesThere();
    return std::count_if(there.begin(), there.end(),
                         [&](std::int64_t frame) { return frame >= frames.first && frame <= frames.last; });
}

// False when it was stopped.
bool runShards(const RenderFlags& flags, const RunPart& part, const JobsFolder& folder, const std::atomic<bool>& stop) {
    const std::int64_t frames = part.frames.last - part.frames.first + 1;
    Jobs jobs(flags, folder, std::min<std::int64_t>(flags.jobs, frames));
    const image::FramePattern pattern(folder.frames());
    LiveLine line(flags.quiet);
    while (jobs.areRunning() && !stop) {
        jobs.expectSuccess();
        if (line.isDue(false)) line.show(fmt::format("{} of {} frames drawn", drawnOf(pattern, part.frames), frames));
        Jobs::pause();
    }
    if (stop) return false;
    jobs.expectSuccess();
    if (line.isDue(true)) line.show(fmt::format("{} of {} frames drawn", drawnOf(pattern, part.frames), frames));
    return true;
}

// What the shards have computed on their way is what was simulated before them.
void expectStates(const FrameJoin& join, std::uint64_t key, const pipeline::RecordLog& states) {
    for (const pipeline::PartRecord& record : join.records) {
        bool isSame = record.key == fmt::format("{:016x}", key) && record.hashes.size() <= states.size();
        for (std::size_t i = 0; isSame && i < record.hashes.size(); ++i) isSame = record.hashes[i] == states[i].hash;
        if (!isSame)
            throw core::Error(core::ErrorKind::inputOutput,
                              fmt::format("{} is not of the run that was simulated", record.path.string()));
    }
}

}  // namespace

JobsFolder::JobsFolder(const std::filesystem::path& output)
    : path_(folderFor(output)),
      frames_(image::isVideoPath(output) ? path_ / "frames" : output),
      lock_(path_, {std::nullopt, fmt::format("taut render --jobs, process {}", ::getpid())}) {
    std::filesystem::remove_all(states());
    if (frames_ != output) std::filesystem::remove_all(frames_);
    std::filesystem::create_directories(states());
}

JobsFolder::~JobsFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::int64_t checkpointEveryFor(int jobs, std::int64_t frames) {
    constexpr std::int64_t statesOfAShard = 4;
    return std::max<std::int64_t>(1, frames / (statesOfAShard * jobs));
}

std::optional<render::RendererInfo> drawByJobs(const RenderFlags& flags, const RunPart& part, std::uint64_t key,
                                               const pipeline::RecordLog& states, const JobsFolder& folder,
                                               image::FrameSink* video, const std::atomic<bool>& stop) {
    if (!runShards(flags, part, folder, stop)) return std::nullopt;
    const FrameJoin join =
        provedFrames(image::FramePattern(folder.frames()), FrameRange{part.frames.first, part.frames.last}, false);
    expectStates(join, key, states);
    if (video != nullptr && !encodeFrames(join, *video, flags.quiet, stop)) return std::nullopt;
    for (const pipeline::PartRecord& record : join.records)
        if (record.first >= part.frames.first && record.last <= part.frames.last) std::filesystem::remove(record.path);
    return join.records.front().gl;
}

void endWithStarter() {
    const char* starter = std::getenv(starterVariable);
    if (starter == nullptr) return;
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (std::to_string(::getppid()) != starter) ::raise(SIGTERM);  // it has ended before that
}

}  // namespace taut::game
