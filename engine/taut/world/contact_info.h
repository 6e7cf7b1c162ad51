// Report of a world about contact between bodies. It knows no body.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace taut::world {

// Contact of bodies that touch others or themselves, counted from the start of the scene or from the last time a body
// came or went.
struct ContactInfo {
    std::vector<std::string> bodies;  // "cloth.flag", …
    struct SurfaceSizes {
        double thickness = 0;     // [m]
        double shortestEdge = 0;  // [m] at rest; 0: no edges
    };
    std::vector<SurfaceSizes> surfaces;  // (bodies)
    int points = 0;                      // of their islands
    int mostDetections = 0;              // largest number in a tick
    int lastDetections = 0;              // of the last tick
    std::int64_t ticks = 0, detections = 0;
    std::int64_t testedPairs = 0;        // checked by the narrow phase in all detections
    double seconds = 0;                  // [s] wall time of detections and certificates
    int lastTestedPairs = 0;             // of the last detection
    int lastImpulses = 0;                // pairs with an impulse in the last step
    std::int64_t slides = 0, zones = 0;  // pairs that were slid apart; rounds in which impact zones moved
    std::int64_t uncertified = 0;        // pairs that may have passed through each other
    std::uint64_t bytes = 0;
};

}  // namespace taut::world
