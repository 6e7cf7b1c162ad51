// Positions and velocities of points over the frames, for programs that compute: an .npz for numpy.load, or a .csv. It
// does not know where they come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace taut::geometry {

// Of one target at one frame: (points) [m], [m/s].
struct PointSet {
    std::span<const glm::dvec3> x, v;
};

class PointsWriter {
  public:
    virtual ~PointsWriter() = default;

    // Expects a set a target. Throws core::Error: inputOutput; badContent where the number of points changes.
    virtual void write(std::int64_t frame, double time, std::span<const PointSet> sets) = 0;
    // Gives the file its name; without it none comes into being. Throws core::Error(inputOutput).
    virtual void finish() = 0;
};

// Whether the name ends in .npz or .csv.
bool isPointsPath(const std::filesystem::path& path);

// .npz, not compressed, numbers of eight bytes: `frame` and `time` (frames), and of each target NAME.x and NAME.v
// (frames, points, 3). .csv: a row a point and frame, numbers to the last bit. Expects isPointsPath(). Throws
// core::Error(inputOutput).
std::unique_ptr<PointsWriter> makePointsWriter(const std::filesystem::path& path, std::vector<std::string> targets);

}  // namespace taut::geometry
