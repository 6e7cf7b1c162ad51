// How good contact is by how often it is looked for and by how many steps a tick has: problems with a known answer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "taut/core/private/listener.h"

namespace taut::study {

// Of the values of all ticks. Least and most have no error on the allowed side of the known value.
enum class Taken { last, least, most };

struct ContactProblem {
    std::string name;   // "ball-bounces"
    std::string title;  // "A ball bounces"
    std::string about;  // the figure and its theory
    std::string scene;  // TOML, without [solver] and [run]
    double seconds = 0;
    int fewestSteps = 0;     // a tick
    std::string expression;  // in the language of checks, of one number
    Taken taken = Taken::last;
    bool isShare = false;  // of the value after the first tick
    double known = 0;
};
std::span<const ContactProblem> contactProblems();

struct ContactRun {
    std::string problem;
    int steps = 0, detections = 0;  // a tick
    double value = 0, error = 0;    // value / known - 1
    int crossings = 0;              // most in a tick
    double milliseconds = 0;        // [ms] of processor time a tick
    bool hasEnded = true;           // false: it diverged
};

struct ContactStudy {
    std::vector<ContactRun> runs;  // by problem, steps, detections
    bool isInterrupted = false;    // only whole problems are kept
};

struct ContactSettings {
    std::vector<std::string> problems{};                     // none: all
    std::vector<int> steps = {1, 4, 16};                     // times the fewest of the problem
    std::vector<int> detections = {1, 2, 4, 8, 16, 32, 64};  // up to the steps
    core::Listener listener{};
};

ContactStudy studyContact(const ContactSettings& settings = {});

}  // namespace taut::study
