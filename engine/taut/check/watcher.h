// Holds a run against the checks of its scene, tick by tick. It plays nothing and prints nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "taut/check/check.h"
#include "taut/spec/claim_spec.h"

namespace taut::world {
struct SceneSpec;
class World;
}  // namespace taut::world

namespace taut::check {

// An outcome with its moment.
struct Sighting {
    std::int64_t tick = 0;
    std::int64_t frame = 0;  // the first tick that shows it or its consequence
    double time = 0;         // [s]
    Outcome outcome;
    std::string where;  // see Check::where
};

struct Result {
    std::string that;  // the claim
    world::Source source;
    std::string span;  // when it must hold: "always", "at 2 s", "from 1 s to 3 s"
    bool passed = false;
    std::int64_t looks = 0, failures = 0;  // ticks at which it was evaluated, and failed
    std::optional<Sighting> first;         // where it failed first; none: it never did
    std::optional<Sighting> worst;         // where it failed by most, or came nearest to; none: no moment came
    std::string reason;                    // in one line; empty if it passed
};

class Watcher {
  public:
    // Throws core::Error(badContent) for a claim that cannot be read, which a loaded scene has not.
    explicit Watcher(const world::SceneSpec& scene);

    // Once a tick with the published state, from tick 0 on; later ticks in ascending order. Throws
    // core::Error(badContent) for a claim about points that are not there.
    void look(const world::World& world);

    // Of the looks so far, in the order of the file. A check whose moments have not all come has failed.
    std::vector<Result> results() const;

  private:
    struct Watched {
        Check check;
        world::CheckSpec spec;
        std::int64_t begin = 0, end = 0;  // ticks, both included
        std::int64_t last = -1;           // tick looked at
        Result result;
    };
    void lookAt(Watched& watched, const Now& now);

    double ticksPerSecond_ = 60;
    std::int64_t lastTick_ = 0;  // that the run shows
    std::vector<Watched> watched_;
    Selections selections_;
};

// "2.317 s, frame 139"
std::string momentText(const Sighting& sighting);

// "0.13 m", or "0.13"
std::string quantityText(double value, const std::string& unit);

}  // namespace taut::check
