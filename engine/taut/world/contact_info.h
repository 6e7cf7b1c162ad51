// What is told about contact between bodies. It knows none of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace taut::world {

// About bodies that touch others or themselves. It counts from the start of the scene, or from when a body last came or
// went.
struct ContactInfo {
    std::vector<std::string> bodies;  // "cloth.flag", …
    struct SurfaceSizes {
        double thickness = 0;     // [m]
        double shortestEdge = 0;  // [m] at rest; 0: it has none
    };
    std::vector<SurfaceSizes> surfaces;  // (bodies)
    int points = 0;                      // of their islands
    int mostInstants = 0;                // a tick, at most
    int lastInstants = 0;                // of the last tick
    std::int64_t ticks = 0, instants = 0;
    std::int64_t testedPairs = 0;        // that the narrow phase looked at, in all instants
    double seconds = 0;                  // of wall time, in all instants
    int lastTestedPairs = 0;             // of the last instant
    int lastImpulses = 0;                // pairs of the last instant that have an impulse
    std::int64_t candidateLists = 0;     // that were made
    std::int64_t slides = 0, zones = 0;  // pairs that were slid apart, and rounds in which impact zones were moved
    std::int64_t uncertified = 0;        // pairs that may have gone through each other
    std::uint64_t bytes = 0;
};

}  // namespace taut::world
