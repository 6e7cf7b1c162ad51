#include "taut/study/problems.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/error.h"
#include "taut/study/first_order_subject.h"
#include "taut/study/mechanical_subject.h"

namespace taut::study {
namespace {

// The slides' own equations.
std::unique_ptr<Subject> makeGrowth() {
    return makeFirstOrderSubject({.name = "growth",
                                  .title = "y' = y, y(0) = 1, to t = 1",
                                  .single = [](double, float y) { return y; },
                                  .full = [](double, double y) { return y; },
                                  .solution = [](double t) { return std::exp(t); }});
}

std::unique_ptr<Subject> makeQuotient() {
    return makeFirstOrderSubject({.name = "quotient",
                                  .title = "y' + y/x = −4, y(1) = 1, to x = 2",
                                  .start = 1,
                                  .single = [](double x, float y) { return -4.0F - y / static_cast<float>(x); },
                                  .full = [](double x, double y) { return -4.0 - y / x; },
                                  .solution = [](double x) { return 3 / x - 2 * x; }});
}

const glm::dvec3 slanting = glm::normalize(glm::dvec3(0.0, -1.0, 0.5));

const ProblemInfo table[] = {
    {"growth", "y' = y, y(0) = 1 to t = 1", makeGrowth},
    {"quotient", "y' + y/x = -4, y(1) = 1 to x = 2", makeQuotient},
    {"projectile", "a point mass thrown, with linear drag", makeProjectile},
    {"oscillator", "a mass on a spring, undamped",
     [] { return makeOscillator("oscillator", "Oscillator without damping, 5 s at 6 rad/s", 0.0); }},
    {"underdamped", "the same with a damping ratio of 0.1",
     [] { return makeOscillator("underdamped", "Oscillator, damping ratio 0.1, 5 s at 6 rad/s", 0.1); }},
    {"critical", "the same, critically damped",
     [] { return makeOscillator("critical", "Oscillator, critically damped, 5 s at 6 rad/s", 1.0); }},
    {"overdamped", "the same with a damping ratio of 2",
     [] { return makeOscillator("overdamped", "Oscillator, damping ratio 2, 5 s at 6 rad/s", 2.0); }},
    {"pendulum", "a mass on an elastic string, swinging in space", makePendulum},
    {"chain", "sixteen masses between two walls, three modes at once", makeChain},
    {"net", "a square net of 8 x 8 masses under tension, three modes at once", makeNet},
    {"cloth-top", "a 16 x 16 cloth held at its top row, released out of the vertical",
     [] { return makeCloth("cloth-top", "Hanging cloth, 16 × 16 cells, top row held", {"top"}, slanting); }},
    {"cloth-corners", "a 16 x 16 cloth held at two corners, released",
     [] {
         return makeCloth("cloth-corners", "Hanging cloth, 16 × 16 cells, two corners held", {"top-left", "top-right"},
                          slanting);
     }},
    {"cloth-edge", "a 16 x 16 cloth held at one edge, released from the horizontal",
     [] {
         return makeCloth("cloth-edge", "Falling cloth, 16 × 16 cells, one edge held", {"left"}, {0, 0, 1});
     }},
};

}  // namespace

std::span<const ProblemInfo> problems() {
    return table;
}

const ProblemInfo* findProblem(std::string_view name) {
    const auto found = std::ranges::find(table, name, &ProblemInfo::name);
    return found == std::end(table) ? nullptr : found;
}

std::unique_ptr<Subject> makeProblem(std::string_view name) {
    const ProblemInfo* problem = findProblem(name);
    TAUT_EXPECTS(problem != nullptr);
    return problem->make();
}

}  // namespace taut::study
