// Flags with a syntax of their own, as plain values. It knows no command.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace taut::game {

struct FrameRange {
    std::int64_t first = 0;
    std::optional<std::int64_t> last;  // included; none: up to the end
};

// "120", "120-239" or "120-"; throws core::Error(usage).
FrameRange frameRange(const std::string& text);

// One of `count` pieces of work.
struct Shard {
    std::int64_t index = 0, count = 1;

    // The pieces are contiguous. Their sizes differ by one at most.
    std::int64_t begin(std::int64_t things) const { return things * index / count; }
    std::int64_t end(std::int64_t things) const { return things * (index + 1) / count; }
    std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
};

// "3/8", the first is 0/8; throws core::Error(usage).
Shard shard(const std::string& text);

struct Size {
    int width = 0, height = 0;  // [px]
};

// "1280x720", each side 16 … 16384; throws core::Error(usage).
Size pictureSize(const std::string& text);

// A check for a flag: empty if its text is a number in least … most, else its fault. Unlike Option::within it rejects
// nan and numbers of hundreds of digits.
std::function<std::string(const std::string&)> numberWithin(double least, double most);

class Options;

// --threads; 0: not given.
void addThreadsFlag(Options& options, int& threads);
// Adds --threads; the returned action does the same as this one, on so many threads.
std::function<int()> withThreads(Options& options, std::function<int()> action);

// --fps and --seconds, which override the run of the scene; 0: not given.
void addRunFlags(Options& options, double& fps, double& seconds);
// An override that a flag stands for; messages about it name the flag.
std::string overrideBy(std::string_view flag, std::string_view key, std::string_view value);
// These flags in the words of the scene format.
void addRunOverrides(double fps, double seconds, std::vector<std::string>& overrides);

// --smooth, which draws all cloth and ropes finer than they are computed; -1: not given.
void addSmoothFlag(Options& options, int& smooth);
void addSmoothOverride(int smooth, std::vector<std::string>& overrides);

// Limits of `--seconds`; values beyond them are slips.
inline constexpr double leastSeconds = 1e-3, mostSeconds = 86400.0;  // [s]

}  // namespace taut::game
