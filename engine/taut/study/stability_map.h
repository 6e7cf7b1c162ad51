// How fast the damped oscillator grows or falls under each method, measured over many steps, and where it begins to
// grow beside where theory says so. It draws and writes nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "taut/core/private/listener.h"
#include "taut/ode/method.h"
#include "taut/study/oscillator.h"

namespace taut::study {

// Growth per step of the amplitude √(x² + v²/ω²) at z = ωh, from `steps` steps of two starts that span all others:
// velocities synchronised, the state scaled back now and then so that nothing overflows. The first half of the steps
// is left out, and the slope of the logarithm over the rest is taken with weights that fade at both ends, so that
// swings of the amplitude within a period hardly count. 0 when all motion has gone.
double measuredGrowth(std::string_view method, double zeta, Damping damping, double z, int steps);

// The largest stable z that the method's own formula tells; infinite without limit, 0 when every step grows.
double predictedLimit(const ode::MethodInfo& method, double zeta, Damping damping);

// The smallest z at which growth above 1 is measured, up to `most`; infinite when there is none.
double measuredLimit(std::string_view method, double zeta, Damping damping, double most,
                     double suspected = std::numeric_limits<double>::infinity());

inline constexpr double growthTolerance = 1e-9;  // a step: less than that counts as none
inline constexpr int limitSteps = 2000;          // with which a boundary is measured

struct Boundary {
    double zeta = 0;
    double predicted = 0, measured = 0;  // ωh; infinite: none
};

// A method with damping of one kind.
struct StabilityPanel {
    std::string method, title;
    Damping damping = Damping::drag;
    bool isDampingAlike = false;       // the other kind has the same limits, and no map of its own
    std::vector<double> growth;        // (rows × columns) per step, rows by z, columns by ζ; empty: no map
    std::vector<Boundary> boundaries;  // by ζ
    double largestGap = 0;             // |measured - predicted|
    double gapZeta = 0;                // where
    bool isWithoutLimit = false;       // predicted and measured
};

struct StabilityMap {
    int columns = 0, rows = 0;
    double mostZeta = 2, mostZ = 4;      // of the map, from 0 and from mostZ / rows
    double mostMeasured = 10;            // z up to which boundaries are looked for
    int steps = 0;                       // behind each point of a map
    std::vector<StabilityPanel> panels;  // in the order of the method table
    bool isInterrupted = false;
    double zetaAt(int column) const { return columns > 1 ? mostZeta * column / (columns - 1) : 0.0; }
    double zAt(int row) const { return mostZ * (row + 1) / rows; }
};

struct StabilityMapSettings {
    std::vector<std::string> methods;  // empty: all
    int columns = 101;                 // of a map; as many rows
    int boundaries = 41;               // values of ζ at which the boundary is measured
    core::Listener listener{};
};

StabilityMap measureStability(const StabilityMapSettings& settings);

}  // namespace taut::study
