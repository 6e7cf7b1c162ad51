// A round tube along a polyline: how a rope is drawn.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "taut/view/frame_view.h"

namespace taut::view {

// The topology of a tube through `points` polyline points (>= 2), `subdivisions` rings a segment (Catmull-Rom) and
// `sides` corners a ring (>= 3), closed by round caps; `length` [m] scales uv, `radius` [m].
Topology tubeTopology(int points, int subdivisions, int sides, float length, float radius);

// Vertices that fit tubeTopology with the same arguments, line (points) [m]; the frame is carried along without twist
// (double reflection). Coincident points are allowed.
Geometry tubeGeometry(std::span<const glm::vec3> line, int subdivisions, int sides, float radius);

}  // namespace taut::view
