// Plays a scene and passes its geometry to writers, which work at the same time as the world. It knows no format.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "taut/geometry/geometry_sink.h"
#include "taut/geometry/points_writer.h"

namespace taut::world {
class World;
}  // namespace taut::world

namespace taut::pipeline {

struct GeometryRun {
    std::int64_t firstFrame = 0;         // frames before it are simulated and not written
    std::int64_t lastFrame = 0;          // included
    std::int64_t every = 1;              // points are written of the frames first, first + every, …, and the last
    std::vector<std::string> targets{};  // whose points are written
    std::string mayTear{};               // endings of files that may tear, ".usda", for messages
    std::function<void(std::int64_t frame)> frameSimulated{};  // called on a thread of its own
};

// Plays a world from its start. Frames firstFrame … lastFrame go to the sink, and to the points; either may be null. If
// the run reaches its end, both are finished. If `stop` becomes true, neither is, and the result is false. Throws
// core::Error: diverged; badContent, with the tick, if a body tears and the sink allows only one topology; exceptions
// of the writers.
bool exportGeometry(world::World& world, const GeometryRun& run, geometry::GeometrySink* sink,
                    geometry::PointsWriter* points, const std::atomic<bool>& stop);

}  // namespace taut::pipeline
