// The state of a run at every tick, as hashes: of the entire chain, of each body, and optionally of each point.
// Independent of pictures and tolerances; hashes agree or they do not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "taut/island/report.h"
#include "taut/scene/private/used_files.h"
#include "taut/world/result_bits.h"

namespace taut::world {
class World;
}

namespace taut::regression {

// Where a tape comes from.
struct TapeOrigin {
    std::string program, compiler, simd;   // as in run.json
    std::string scene;                     // the file that was played; empty in a tape that belongs to a scenario
    std::string text;                      // content of that file
    std::vector<std::string> overrides;    // "key=value"
    std::vector<scene::UsedFile> files{};  // that it depends on; none in one that belongs to a scenario
    int bits = world::resultBits;          // generation of results
};

// The bodies that a tick has hashes of.
struct TapeBodies {
    std::vector<std::string> names;  // "cloth.flag", in the order of the state hash
    std::vector<int> points;         // (names) how many have a hash; 0 where points are not recorded
    bool operator==(const TapeBodies&) const = default;
};

struct Tape {
    TapeOrigin origin;
    double tickSeconds = 0;  // [s]
    int ticksPerFrame = 1;

    std::vector<std::uint64_t> chain;    // (ticks) from tick 0, the start, on
    std::vector<TapeBodies> casts;       // each other than the one before: a body may be spawned
    std::vector<std::uint32_t> castOf;   // (ticks) index into casts
    std::vector<std::uint64_t> bodies;   // (ticks × bodies of that tick)
    std::vector<std::uint32_t> points;   // (ticks × points of that tick), folded to 32 bits
    std::vector<std::size_t> bodyAt{};   // (ticks) where in `bodies` a tick begins
    std::vector<std::size_t> pointAt{};  // (ticks) where in `points` a tick begins

    std::int64_t ticks() const { return static_cast<std::int64_t>(chain.size()) - 1; }  // after the start
};

void visit(core::Bytes& bytes, TapeBodies& cast);
void visit(core::Bytes& bytes, Tape& tape);

// A tape of this program, without ticks.
Tape blankTape();

// Adds the moment that the world is at, which follows the last one on the tape; of a world after its start the rates.
void addTick(Tape& tape, world::World& world, bool withPoints);

// Adds the present moment of a world and those up to the tick `last`; ends before it on divergence, which it returns,
// or where `goesOn` is false.
std::optional<world::Divergence> addTicks(Tape& tape, world::World& world, std::int64_t last, bool withPoints,
                                          const std::function<bool()>& goesOn);

// Throw core::Error: inputOutput, or badContent for other files, a damaged tape, or one of another version.
void writeTape(const std::filesystem::path& path, const Tape& tape);
Tape readTape(const std::filesystem::path& path);

}  // namespace taut::regression
