// The surface of a body, or of a collider: triangles and edges, in the numbering of points of the whole group. Plain
// data.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "taut/core/turn_friction.h"

namespace taut::contact {

using glm::dvec3;

struct ContactSurface {
    std::vector<int> points;                    // of the group
    std::vector<std::array<int, 3>> triangles;  // of points
    std::vector<std::array<int, 2>> lines;      // edges of no triangle: of ropes and nets
    // (lines) Of a rigid surface: a point on each of the two faces beside a line, off the line; -1: no face. They are
    // not in `points`.
    std::vector<std::array<int, 2>> wings;
    double thickness = 0.005;  // [m] two surfaces keep a distance of the sum of theirs
    double friction = 1.0;     // factor on the friction of the group [-]
    double restitution = 1.0;  // likewise
    core::TurnFriction turnFriction{};
    bool meetsItself = true;
    bool meetsOthers = true;
    bool meetsRigid = true;  // touches surfaces of colliders
    // Surfaces with the same bond belong to one body. Its parts are close at rest, so they keep at most restShare of
    // their distance at rest.
    int bond = 0;
    // Surfaces with the same number, from 0, are of one rigid body. They do not meet. -1: not rigid.
    int solid = -1;
    // Its points, edges and faces meet shapes, which others find (Instant).
    bool meetsShapes = false;
    // A rigid convex shape. Its elements do not meet those of another one: the caller finds these contacts
    // (Instant::rigid).
    bool isConvex = false;
    // Besides, its distance is a formula, and elements of bodies meet it by that.
    bool isFormula = false;
    // A collider's corners and edges, which the group does not move. It has no triangles: points meet the faces of
    // colliders in `collision`. Two rigid surfaces never touch.
    bool isRigid = false;
    // A collider that moves and deforms as it likes: triangles whose points the group does not move. Like a rigid
    // surface it meets only bodies that meet colliders.
    bool isDriven = false;
    // (points) Of a driven surface, whose points have ascending numbers without gaps: where parts of it close upon a
    // body, the one of the lowest rank presses on, and the others go through it.
    std::vector<int> ranks;

    bool isOfCollider() const { return isRigid || isDriven; }
};

// Parts of one body keep at most this share of their distance at rest.
inline constexpr double restShare = 0.7;

// A pair is near, so that it has to be measured, when its distance is below this share of its thickness.
inline constexpr double nearShare = 1.05;

}  // namespace taut::contact
