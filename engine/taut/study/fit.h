// Fits the numbers of a scene to measurements, by least squares over entire runs: from the numbers of the scene, and
// from others between the bounds while the targets are not met. Independent of files.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "taut/scene/private/splice.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::study {

// A run with other numbers.
struct FitTrial {
    std::vector<double> values;  // (keys)
    double misfit = 0;           // sum over all measured values of (off / sigma)²; infinite where the run failed
    std::string failure;
};

struct FitSettings {
    // The scene with these values of [fit] keys, to six digits. Called on several threads at a time.
    std::function<world::SceneSpec(const std::vector<double>& values)> scene;
    int most = 300;                                      // trials
    std::function<void(const FitTrial&, int)> progress;  // after each, with its number; one call at a time
    const std::atomic<bool>* stop = nullptr;
};

struct FittedKey {
    std::string key;
    double before = 0, value = 0, low = 0, high = 0;
    double deviation = 0;  // standard; not a number where a bound holds it or it is not told apart
    bool isHeld = false;
    bool isLogarithmic = false;
};

struct FittedTarget {
    std::string that, when;          // "at 3 s", "41 values of strip.csv"
    double wanted = 0, reached = 0;  // of a curve where it is farthest off
    double time = 0;                 // [s] of those
    double off = 0;                  // RMS of off / sigma
    bool isMet() const { return off <= 3; }
};

struct Fit {
    std::string name;
    std::vector<FittedKey> keys;
    std::vector<FittedTarget> targets;
    std::vector<FitTrial> trials;                  // in the order of trying
    double misfit = 0;                             // at the end
    int starts = 1;                                // from which it was sought
    int values = 0;                                // that were measured
    std::vector<std::vector<double>> unseen;       // (directions)(keys) see Minimum
    std::vector<std::vector<double>> correlation;  // (keys)(keys)
    bool hasConverged = false;
    std::vector<scene::Change> changes;  // of the scene file; none where the scene has these values

    bool areTargetsMet() const;
    bool isMet() const;  // and the values are the only ones
};

// Expects input that the loader accepts. Throws core::Error: badContent without [fit], diverged if the unchanged scene
// does not run, interrupted.
Fit makeFit(const world::SceneSpec& spec, const FitSettings& settings);

}  // namespace taut::study
