// The oscillator in the plane of x and v/ω, as the lecture draws it: where each method's steps lead from one start.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::study {

struct PhasePoint {
    double x = 0, v = 0;  // v/ω, synchronised
};

struct PhasePath {
    std::string method, title;
    std::vector<PhasePoint> points;  // (steps + 1) from (1, 0) on
    double growthPerTurn = 1;        // of the amplitude, from the first step to the last
};

// Sixteen steps of leap-frog make exactly one turn: its angle a step is 2 asin(z/2).
inline constexpr int stepsPerTurn = 16;
double phasePlaneStep();  // z = ωh = 2 sin(π/16)

PhasePath phasePath(std::string_view method, double z, int steps);

// Of the methods by name, or of all in the order of the table; two turns each.
std::vector<PhasePath> phasePaths(const std::vector<std::string>& methods);

}  // namespace taut::study
