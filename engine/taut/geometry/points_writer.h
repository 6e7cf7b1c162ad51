// Positions and velocities of points over the frames, for programs that compute: an .npz for numpy.load, or a .csv. It
// does not know where they come from.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace taut::geometry {

// Of one target at one frame: (points) [m], [m/s].
struct PointSet {
    std::span<const glm::dvec3> x, v;
};

// The engine's: .npz, not compressed, numbers of eight bytes: `frame` and `time` (frames), and of each target NAME.x
// and NAME.v (frames, points, 3). .csv: a row a point and frame, numbers to the last bit.
class PointsWriter {
  public:
    virtual ~PointsWriter() = default;

    // Expects a set a target. Throws core::Error: inputOutput; badContent where the number of points changes.
    virtual void write(std::int64_t frame, double time, std::span<const PointSet> sets) = 0;
    // Gives the file its name; without it none comes into being. Throws core::Error(inputOutput).
    virtual void finish() = 0;
};

}  // namespace taut::geometry
