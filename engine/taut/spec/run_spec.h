// How long a run is, and how many pictures it has.
#pragma once

namespace taut::world {

struct RunSpec {
    double fps = 60.0;     // pictures a second of scene time
    double seconds = 5.0;  // length
};

}  // namespace taut::world
