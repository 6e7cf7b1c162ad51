// Cuts a panel of cloth, a polygon with holes, into triangles that are nearly equilateral and alike in size. It knows
// no material.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "taut/core/error.h"

namespace taut::mechanics {

struct PanelShape {
    // The outline, then the outlines of holes; each may run either way [m].
    std::vector<std::vector<glm::dvec2>> rings;
    double cell = 0.02;          // length that edges shall have [m]
    glm::dvec2 along{1.0, 0.0};  // unit; rows of points inside run along it
    // (rings)(sides) How many edges each side gets; 0, or not there: as many as the cell says.
    std::vector<std::vector<int>> edges{};
};

struct PanelMesh {
    std::vector<glm::dvec2> points;             // those of the rings first, in their order, each from its corner 0 on
    std::vector<std::array<int, 3>> triangles;  // counter-clockwise
    std::vector<std::vector<int>> corners;      // (rings)(corners) their points
    int ringEnd(std::size_t ring) const {       // one past the last point of a ring
        return ring + 1 < corners.size() ? corners[ring + 1].front() : outlinePoints;
    }
    int outlinePoints = 0;  // of all rings
};

// A fault of an outline and its place: a corner, or the side from it to the next. -1: nowhere in particular.
struct PanelFault : core::Error {
    PanelFault(const std::string& what, int ring_, int corner_)
        : Error(core::ErrorKind::badContent, what), ring(ring_), corner(corner_) {}
    int ring, corner;
};

// A side gets as many edges as bring their length nearest to the cell: 1/2 to 3/2 of it. Inside there are rows of
// equilateral triangles, whose points then move between their neighbours; the triangulation is that of Delaunay that
// keeps to the outline. Where the panel is two cells wide, and but for the corners of the outline, no angle is below
// 25°. Same bits on every machine. Throws PanelFault for fewer than three corners, a side below half a cell, a spike
// below 6°, rings that touch, cross or lie in each other, holes outside, and more than a million points.
PanelMesh meshPanel(const PanelShape& shape);

}  // namespace taut::mechanics
