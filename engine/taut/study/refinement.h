// Does a finer body behave as a coarse one? Ropes, cloths and blocks at rest, at several resolutions, with the edges
// weighted by their share of the material or not, against theory. It knows nothing of motion.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "taut/core/private/listener.h"
#include "taut/study/refinement_bodies.h"

namespace taut::study {

// A way to treat the edge of a body.
struct Treatment {
    std::string name;   // "weighted"
    std::string title;  // "edges weighted by their share"
    Lumped lumped;
};
const std::vector<Treatment>& treatments();  // the first is the builders' own

struct RefinementRun {
    std::string body, treatment;
    int cells = 0;  // along the longest side
    long long points = 0, springs = 0;
    double value = 0;  // [m] as the body's quantity says
    double error = 0;  // value/theory - 1; of a body without theory, against the limit
    double order = std::numeric_limits<double>::quiet_NaN();  // from the resolution before to this one
    double residual = 0;                                      // largest acceleration left, over g
    int steps = 0;
    bool isAtRest = false;
};

struct RefinementFacts {
    const RefinementBody* body = nullptr;
    double reference = 0;           // [m] scale of the errors
    std::vector<double> strongest;  // (treatments) largest |error|
};

struct RefinementStudy {
    std::vector<RefinementFacts> bodies;
    std::vector<RefinementRun> runs;  // by body, treatment, cells
    bool isInterrupted = false;       // only whole bodies are kept
};

// Below this a relative error is that of the solver and of strains that are not quite zero: the body is exact.
inline constexpr double refinementFloor = 3e-6;

struct RefinementSettings {
    std::vector<std::string> bodies;          // none: all
    std::vector<int> cells = {4, 8, 16, 32};  // each twice the one before; at least three
    core::Listener listener{};
};

RefinementStudy studyRefinement(const RefinementSettings& settings = {});

// Order of the error as the cells shrink, from the two finest resolutions. Not a number when the body is exact, its
// runs did not come to rest, or there is no such series.
double measuredOrder(const RefinementStudy& study, const std::string& body, const std::string& treatment);

}  // namespace taut::study
