// What a run is compared with: theory where there is a solution, else RK4 at a much smaller step, checked against
// itself at half of that.
#pragma once

#include <vector>

#include "taut/study/subject.h"

namespace taut::study {

struct Reference {
    std::vector<Observation> at;  // (samples)
    bool isExact = false;
    double step = 0;              // [s] of the finer run; 0 when exact
    double difference = 0;        // RMS over the window between the runs at 2 · step and at step
    double energyDifference = 0;  // [J] largest
    // Errors below this are not told apart from those of the reference: 100 times its difference.
    double floor = 0;
    double energyFloor = 0;  // [J]
    double extent = 0;       // size of all that the reference covers: diagonal of its box, or the largest |y|
    double kinetic = 0;      // [J] largest: the scale of energies
};

// The first `window` samples count for the difference. `seconds` is the wall time that the finer run may take.
Reference makeReference(const Subject& subject, const Grid& grid, int window, double seconds);

}  // namespace taut::study
