// What is told of contact between bodies. It knows none of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace taut::world {

// Of bodies that touch others or themselves, since the scene began or a body came or went.
struct ContactInfo {
    std::vector<std::string> bodies;  // "cloth.flag", …
    struct Surface {
        double thickness = 0;     // [m]
        double shortestEdge = 0;  // [m] at rest; 0: it has none
    };
    std::vector<Surface> surfaces;  // (bodies)
    int points = 0;                 // of their islands
    int mostInstants = 0;           // a tick, at most
    int lastInstants = 0;           // of the last tick
    std::int64_t ticks = 0, instants = 0;
    std::int64_t locatedInAll = 0;       // pairs that were looked at, in all instants
    double seconds = 0;                  // of wall time, in all instants
    int located = 0, pressing = 0;       // pairs of the last instant: looked at, and with an impulse
    std::int64_t lists = 0;              // of pairs that were made
    std::int64_t slides = 0, zones = 0;  // pairs that had to be slid apart, and times that zones were moved as one
    std::int64_t uncertified = 0;        // pairs that may have gone through each other
    std::uint64_t bytes = 0;
};

}  // namespace taut::world
