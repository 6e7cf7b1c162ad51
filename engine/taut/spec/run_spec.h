// The length of a run and its picture rate.
#pragma once

namespace taut::world {

struct RunSpec {
    double fps = 60.0;     // pictures a second of scene time
    double seconds = 5.0;  // length
};

}  // namespace taut::world
