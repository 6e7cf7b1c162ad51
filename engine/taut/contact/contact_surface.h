// What of a body others touch: its triangles and edges, as points of a group that is numbered together. Plain data.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace taut::contact {

using glm::dvec3;

struct Surface {
    std::vector<int> points;                    // of the group
    std::vector<std::array<int, 3>> triangles;  // of points
    std::vector<std::array<int, 2>> lines;      // edges besides those of the triangles: of ropes and nets
    // Of a rigid surface (lines): points on the faces beside a line, off it; -1: none. They are none of its points.
    std::vector<std::array<int, 2>> wings;
    double thickness = 0.005;  // [m] two surfaces keep the sum of theirs
    double friction = 1.0;     // factor on the friction of a group [-]
    bool meetsItself = true;
    bool meetsOthers = true;
    bool meetsRigid = true;  // besides the others
    // Surfaces of one bond are one body, whose parts may be as near as they are at rest, and need not be further apart
    // than `restShare` of that.
    int bond = 0;
    // Moved by others than the group: a collider's corners and edges, which meet triangles and edges from outside;
    // points of others meet its faces elsewhere, so that it has no triangles. Two of them never meet.
    bool isRigid = false;
};

// Share of the distance at rest that parts of one body keep at most.
inline constexpr double restShare = 0.7;

// Nearer than this share of the distance that two keep, they are in contact.
inline constexpr double nearShare = 1.05;

}  // namespace taut::contact
