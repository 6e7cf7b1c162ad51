// One way to model and compute a scene: its resolution, force generators, method, step and precision, and the scene
// that comes of it. It runs nothing.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "taut/spec/solver_spec.h"

namespace taut::world {
struct IslandInfo;
struct SceneSpec;
}  // namespace taut::world

namespace taut::study {

// Parts of a scene that can be left out.
struct Generator {
    std::string name;                    // "wind breeze", "drag", "bend springs", …
    std::vector<std::string_view> keys;  // of the numbers that are all zero without it, see scene::eachNumber
    std::string owner{};                 // that has them, e.g. "wind.breeze"; empty: every body and material
    bool setsCost = true;                // springs, cells or the step hang on it
};

using Generators = std::vector<Generator>;

// Generators of the scene itself: fabrics of the library are not changed.
Generators generatorsOf(const world::SceneSpec& spec);

// Which bodies may be built of more or fewer cells, and why the others may not.
struct Resolution {
    int count = 0;  // cells or segments along the longest edge of all that may; 0: none may
    int most =
        std::numeric_limits<int>::max();       // beyond it cells of bodies that touch are smaller than they keep apart
    std::vector<std::string> scalable;         // "cloth.flag", …
    std::map<std::string, std::string> fixed;  // by body, why
};
Resolution resolutionOf(const world::SceneSpec& spec);

struct Candidate {
    int count = 0;       // cells along the longest edge, see Resolution; the others go with it
    Generators without;  // left out
    std::string method = "leapfrog";
    world::Precision precision = world::Precision::double_;
    int substeps = 0;  // of the island that needs most, as it starts; 0: as many as dt = "auto" finds
};

// The cost of an evaluation of an island's forces and its overhead: its springs and points, and the equivalent of other
// work.
double costOf(const world::IslandInfo& island);

// The result of dt = "auto" for a scene.
struct StepFacts {
    int leastSubsteps = 1;   // of the island that needs most, as it starts
    double limit = 0;        // [s] its largest stable step wherever it goes: of a dt by hand
    bool isPossible = true;  // false: every step is unstable, or more than a million a tick
    double springs = 0;      // of all islands
    double cost = 0;         // of an evaluation of each
    double stepCost = 0;     // Σ cost · substeps a tick
    int islands = 1;
    double tick = 0;  // [s]
};

// Every resolution would be shaken in another way.
world::SceneSpec withoutJitter(world::SceneSpec spec);

// The scene without jitter, overrides of its bodies aligned, at `count` cells and without `without`; its step is
// "auto".
world::SceneSpec modelOf(const world::SceneSpec& spec, const Resolution& resolution, const Candidate& candidate);

StepFacts stepFacts(const world::SceneSpec& model);

// The model with its step set so that the slowest island begins with `substeps` of them a tick; 0 leaves "auto".
// A single island gets dt where a dt by hand is stable wherever it goes; else `safety`, so that all steps shrink by the
// same share and still follow the state.
void setSubsteps(world::SceneSpec& model, const StepFacts& facts, int substeps);

}  // namespace taut::study
