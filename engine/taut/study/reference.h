// The reference of a run: theory if there is a solution, else a method of order 8 that controls its own error, at two
// tolerances. Contact is of order 1 for any method: with contact it is RK4 at a much smaller step, checked against
// itself at twice that.
#pragma once

#include <string>
#include <vector>

#include "taut/study/subject.h"

namespace taut::study {

struct Reference {
    std::vector<Observation> at;  // (samples)
    bool isExact = false;
    bool isControlled = false;    // by Fehlberg's method; other computed references are RK4 at two steps
    double tolerance = 0;         // [unit/s] of the finer run, where controlled
    double step = 0;              // [s] of the finer run, where not controlled
    double difference = 0;        // RMS over the window between the two runs
    double energyDifference = 0;  // [J] largest
    // Of the finer run, RMS over the window: a tenth of the difference, as its tolerance is a hundredth of the other's
    // and its longest step half (contacts: all of it, as its step is half of the other's and the order is 1).
    double error = 0;
    // Errors below this are not told apart from those of the reference: 100 times its own.
    double floor = 0;
    double energyFloor = 0;  // [J]
    double extent = 0;       // size of all that the reference covers: diagonal of its box, or the largest |y|
    double kinetic = 0;      // [J] largest: the scale of energies
};

// "Fehlberg 7(8) at tolerances of 1e-10 and 1e-12 m/s", "RK4 at steps of 0.001 and 0.0005 s", "exact".
std::string methodOf(const Reference& reference, const std::string& unit);

// The first `window` samples count for the difference. `seconds` is the wall time that the finer run may take.
Reference makeReference(const Subject& subject, const Grid& grid, int window, double seconds);

}  // namespace taut::study
