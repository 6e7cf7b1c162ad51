// How long a motion can be predicted at all: two runs that start a little apart, and how they part.
#pragma once

#include "taut/study/subject.h"

namespace taut::study {

// Every coordinate of the start is moved by up to this unless a caller has a length of its own. [m]
inline constexpr double perturbation = 1e-9;
// The horizon is where the difference has grown by this factor: a micrometre has become a millimetre. Of motion that
// is not linear that depends on the size of the shift.
inline constexpr double horizonGrowth = 1000;

struct Horizon {
    double seconds = 0;      // until the growth is reached; the whole duration when it is not
    bool isReached = false;  // within the duration
    double growth = 0;       // largest that was seen, of the RMS difference
};

// Integrates by RK4 in double precision at a quarter of its stability limit, or where that is too short by a method
// without one. A shift [m] that is lost in the rounding of the coordinates, or moves nothing, has no horizon: its
// growth counts as 1.
Horizon findHorizon(const Subject& subject, double duration, double shift = perturbation);

}  // namespace taut::study
