// The largest stable step of each method in a scene, found by trial, beside bounds and theory. It draws and writes
// nothing.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "taut/core/private/listener.h"
#include "taut/ode/method.h"
#include "taut/study/stability_map.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::study {

// Frequencies of an island as the scene starts [1/s].
struct IslandFrequencies {
    std::string name;
    std::vector<std::string> bodies;
    int points = 0;
    double boundAnywhere = 0;  // B1
    double boundHere = 0;      // B2
    double lanczos = 0;
    double closedForm = std::numeric_limits<double>::quiet_NaN();  // none
    std::string formula;                                           // of the closed form
    ode::FastestMode mode;                                         // with B1
};

// ω_max of an island of one body, in closed form: a straight rope held at both ends without bend
// springs, or a grid of square cells. NaN otherwise; `formula` says which.
double closedFormFrequency(const world::SceneSpec& spec, const std::vector<std::string>& bodies, std::string& formula);

enum class ThresholdKind {
    found,      // between two steps that were tried
    aboveMost,  // every step tried stands, up to the longest that a scene allows
    belowLeast  // none does
};

// Largest steps [s] by the method's formula, of the island where that is smallest; 0: grows at every step; infinite:
// no limit; NaN: no closed form.
struct PredictedSteps {
    double boundAnywhere = 0, boundHere = 0, lanczos = 0;
    double closedForm = std::numeric_limits<double>::quiet_NaN();
};

struct MethodThreshold {
    std::string method, title;
    ThresholdKind kind = ThresholdKind::found;
    double stands = 0;  // [s] the largest step that was seen to hold; 0: none
    double fails = 0;   // [s] the smallest that was seen to fail; 0: none
    PredictedSteps predicted;
    std::string limitedBy;  // body that went first just above, or "energy"
    int runs = 0;
    std::string note;  // notes for the reader; may be empty
};

struct SceneThresholds {
    std::string name, title;
    double seconds = 0;     // [s] of motion in each run
    double mostStep = 0;    // [s] a scene's longest tick
    double kinetic = 0;     // [J] largest of the reference run
    double allowance = 0;   // [J] kinetic energy above which a run counts as failed
    std::string criterion;  // in words
    std::vector<IslandFrequencies> islands;
    std::vector<MethodThreshold> methods;
    bool isInterrupted = false;
};

struct ThresholdSettings {
    std::vector<std::string> methods;  // empty: all
    double seconds = 0;                // [s] of motion; 0: the length of the scene, at most 0.5
    core::Listener listener{};
};

// Bisects until the stable and unstable steps are 1 % apart. Double precision, all bodies by the same method; every
// coordinate of the start is moved by up to 1e-9 m, so that no symmetry hides a mode. Throws exceptions of the world.
SceneThresholds findThresholds(const world::SceneSpec& spec, const std::string& name,
                               const ThresholdSettings& settings);

// Scenes with a closed form: "rope" and "cloth". False when there is none of that name.
bool isReferenceNetwork(const std::string& name);
world::SceneSpec referenceNetwork(const std::string& name);

}  // namespace taut::study
