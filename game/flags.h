// Flags with a form of their own, as plain values. It knows no command.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace taut::game {

struct FrameRange {
    std::int64_t first = 0;
    std::optional<std::int64_t> last;  // included; none: to the end
};

// "120", "120-239" or "120-"; throws core::Error(usage).
FrameRange frameRange(const std::string& text);

// A piece of work that is cut into `count`.
struct Shard {
    std::int64_t index = 0, count = 1;

    // The pieces of so many things are contiguous and differ by one thing at most.
    std::int64_t begin(std::int64_t things) const { return things * index / count; }
    std::int64_t end(std::int64_t things) const { return things * (index + 1) / count; }
    std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
};

// "3/8", the first is 0/8; throws core::Error(usage).
Shard shard(const std::string& text);

struct Size {
    int width = 0, height = 0;  // [px]
};

// "1280x720", each side 1 … 16384; throws core::Error(usage).
Size pictureSize(const std::string& text);

// A check for a flag: empty when its text is a number in least … most, else what is wrong. Unlike Option::within it
// lets neither nan nor numbers of hundreds of digits through.
std::function<std::string(const std::string&)> numberWithin(double least, double most);

class Options;

// --isa, which fixes the instruction set of the kernels before anything asks for it. `isa` holds what was given.
void addInstructionSetFlag(Options& options, std::string& isa);

// --fps and --seconds, which stand over what the scene says of its run; 0: not given.
void addRunFlags(Options& options, double& fps, double& seconds);
// What they ask for, in the words of the scene format.
void addRunOverrides(double fps, double seconds, std::vector<std::string>& overrides);

// What `--seconds` takes: more motion, or less, than anybody waits for is a slip of the hand.
inline constexpr double leastSeconds = 1e-3, mostSeconds = 86400.0;  // [s]

}  // namespace taut::game
