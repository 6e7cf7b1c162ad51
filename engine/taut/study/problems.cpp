#include "taut/study/problems.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "taut/study/first_order_subject.h"

namespace taut::study {
namespace {

constexpr std::array table = {
    ProblemInfo{"growth", "y' = y, y(0) = 1 to t = 1", makeGrowth},
    ProblemInfo{"quotient", "y' + y/x = -4, y(1) = 1 to x = 2", makeQuotient},
    ProblemInfo{"projectile", "a point mass thrown, with linear drag", makeProjectile},
    ProblemInfo{"oscillator", "a mass on a spring, undamped", makeUndamped},
    ProblemInfo{"underdamped", "the same with a damping ratio of 0.1", makeUnderdamped},
    ProblemInfo{"critical", "the same, critically damped", makeCritical},
    ProblemInfo{"overdamped", "the same with a damping ratio of 2", makeOverdamped},
    ProblemInfo{"pendulum", "a mass on an elastic string, swinging in space", makePendulum},
    ProblemInfo{"chain", "sixteen masses between two walls, three modes at once", makeChain},
    ProblemInfo{"net", "a square net of 8 x 8 masses under tension, three modes at once", makeNet},
    ProblemInfo{"cloth-top", "a 16 x 16 cloth held at its top row, released out of the vertical", makeClothTop},
    ProblemInfo{"cloth-corners", "a 16 x 16 cloth held at two corners, released", makeClothCorners},
    ProblemInfo{"cloth-edge", "a 16 x 16 cloth held at one edge, released from the horizontal", makeClothEdge},
};

}  // namespace

std::span<const ProblemInfo> problems() {
    return table;
}

const ProblemInfo* findProblem(std::string_view name) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const ProblemInfo& p) { return p.name == name; });
    return found == table.end() ? nullptr : &*found;
}

std::unique_ptr<Subject> makeGrowth() {
    FirstOrderProblem problem;
    problem.name = "growth";
    problem.title = "y' = y, y(0) = 1, to t = 1";
    problem.single = [](double, float y) { return y; };
    problem.full = [](double, double y) { return y; };
    problem.solution = [](double t) { return std::exp(t); };
    return makeFirstOrderSubject(problem);
}

std::unique_ptr<Subject> makeQuotient() {
    FirstOrderProblem problem;
    problem.name = "quotient";
    problem.title = "y' + y/x = −4, y(1) = 1, to x = 2";
    problem.start = 1;
    problem.single = [](double x, float y) { return -4.0F - y / static_cast<float>(x); };
    problem.full = [](double x, double y) { return -4.0 - y / x; };
    problem.solution = [](double x) { return 3 / x - 2 * x; };
    return makeFirstOrderSubject(problem);
}

}  // namespace taut::study
