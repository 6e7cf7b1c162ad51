#include "game/flags.h"

#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <utility>

#include "game/command_line.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/numbers.h"
#include "taut/core/private/instruction_set.h"
#include "taut/core/private/parallel.h"

namespace taut::game {
FrameRange frameRange(const std::string& text) {
    const auto fail = [&] {
        failUsage("--frames {}: expected a range like 0-119, the first not after the last", text);
    };
    const std::string_view view = text;
    const std::size_t dash = view.find('-');
    const auto first = core::wholeIn<std::int64_t>(view.substr(0, dash));
    if (!first) fail();
    if (dash == std::string_view::npos) return {*first, *first};
    if (dash + 1 == view.size()) return {*first, std::nullopt};
    const auto last = core::wholeIn<std::int64_t>(view.substr(dash + 1));
    if (!last || *last < *first) fail();
    return {*first, last};
}

Shard shard(const std::string& text) {
    constexpr std::int64_t most = 1'000'000;
    const std::string_view view = text;
    const std::size_t slash = view.find('/');
    const auto fail = [&](const std::string& reason) { failUsage("--shard {}: {}", text, reason); };
    const auto index = core::wholeIn<std::int64_t>(view.substr(0, slash));
    const auto count =
        slash == std::string_view::npos ? std::nullopt : core::wholeIn<std::int64_t>(view.substr(slash + 1));
    if (!index || !count) fail("expected a number and a count, like 0/8");
    if (*count < 1 || *count > most) fail(fmt::format("there may be 1 to {} shards", most));
    if (*index >= *count) fail(fmt::format("there is none; they count from 0/{0} to {1}/{0}", *count, *count - 1));
    return {*index, *count};
}

Size pictureSize(const std::string& text) {
    constexpr int least = 16, most = 16384;  // as the format of scenes has it
    const std::string_view view = text;
    const std::size_t cross = view.find('x');
    if (cross != std::string_view::npos) {
        const auto width = core::wholeIn<int>(view.substr(0, cross));
        const auto height = core::wholeIn<int>(view.substr(cross + 1));
        const auto isFine = [&](const std::optional<int>& side) { return side && *side >= least && *side <= most; };
        if (isFine(width) && isFine(height)) return {*width, *height};
    }
    failUsage("--size {}: expected a size in pixels like 1280x720, each from {} to {}", text, least, most);
}

void addRunFlags(Options& options, double& fps, double& seconds) {
    options.value("--fps", fps, "Frames per second of scene time").check(numberWithin(1e-3, 1e6));
    options.value("--seconds", seconds, "Length in scene time").check(numberWithin(leastSeconds, mostSeconds));
}

std::string overrideBy(std::string_view flag, std::string_view key, std::string_view value) {
    return fmt::format("{}={} # {}", key, value, flag);
}

void addRunOverrides(double fps, double seconds, std::vector<std::string>& overrides) {
    if (fps > 0.0) overrides.push_back(overrideBy("--fps", "run.fps", fmt::to_string(fps)));
    if (seconds > 0.0) overrides.push_back(overrideBy("--seconds", "run.seconds", fmt::to_string(seconds)));
}

void addSmoothFlag(Options& options, int& smooth) {
    options
        .value("--smooth", smooth,
               "Draw cloth and ropes 2, 4 or 8 times as fine as they are simulated; 0: as simulated")
        .within(0, 3);
}

void addSmoothOverride(int smooth, std::vector<std::string>& overrides) {
    if (smooth >= 0) overrides.push_back(overrideBy("--smooth", "picture.smooth", fmt::to_string(smooth)));
}

void addThreadsFlag(Options& options, int& threads) {
    options.value("--threads", threads, "Number of threads; default all of the machine").within(1, 1024);
}

std::function<int()> withThreads(Options& options, std::function<int()> action) {
    const auto threads = std::make_shared<int>(0);
    addThreadsFlag(options, *threads);
    return [threads, action = std::move(action)] {
        const core::ThreadLimit limit(*threads);
        return action();
    };
}

std::function<std::string(const std::string&)> numberWithin(double least, double most) {
    return [least, most](const std::string& text) -> std::string {
        const auto value = core::numberIn(text);
        if (value && *value >= least && *value <= most) return "";
        return fmt::format("expected a number from {:g} to {:g}, not {}", least, most, text);
    };
}

}  // namespace taut::game
