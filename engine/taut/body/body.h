// A body of the scene: its model, and the numbers of its points in an island.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "taut/collision/convex.h"
#include "taut/core/value.h"
#include "taut/damage/damage.h"
#include "taut/mechanics/model.h"
#include "taut/spec/body_spec.h"
#include "taut/view/primitives.h"

namespace taut::world {

class Island;

// One of the shapes of a rigid body, as it touches (null: not as a convex shape) and as it is drawn.
struct RigidPiece : collision::PlacedConvex {
    view::Mesh mesh;
};

struct Body {
    TAUT_VALUE(Body);
    std::shared_ptr<const BodySpec> spec;  // its description; all copies of an array share it
    std::string name;                      // "flag", or "flag.2" in an array
    std::int64_t seed = 1;                 // of its jitter
    mechanics::Model model;
    std::vector<RigidPiece> pieces;  // of a rigid body, (parts of the model)
    collision::Frame axes;           // of a rigid body, its own, in the scene as it starts
    PlasticitySpec plasticity;

    std::vector<int> carried;            // ascending points of the model that a collider holds by its spec
    std::vector<bool> clamped;           // (points) whether the direction is held while the point is; empty: none
    glm::dquat carriedFrom{1, 0, 0, 0};  // rotation of that collider when the points were tied to it

    std::vector<int> seamCorners;  // ascending points, from which two borders that are sewn go different ways

    Damage damage;  // by cuts and tears

    // In the island that owns it.
    Island* island = nullptr;
    std::vector<int> pointOf;           // (points) number in the island of each point of the model
    int firstPoint = 0, lastPoint = 0;  // range of points that collide for this body

    std::string_view kind() const { return spec->kind(); }
    const std::string& base() const { return spec->name; }  // "flag"
    std::string fullName() const;                           // "cloth.flag"
};

// All bodies of the scene: arrays expanded, held points set, masses added, starting velocities given, sorted by kind
// and name. Throws core::Error(badContent) naming file, line and column.
std::vector<Body> buildBodies(const SceneSpec& spec);

// The order of the state hash: by kind and name, row.2 before row.10.
bool sortsBefore(const Body& a, const Body& b);

// One body for spawning: at rest and free, arrays not expanded. startBody() does the rest.
Body buildBody(const BodySpec& spec, const SceneSpec& scene);

// Holds the points that its spec names, in place or on a collider. Gives the others their starting velocity and jitter.
// Throws core::Error(badContent) where `hold` names nothing.
void startBody(Body& body);
// [m] How far jitter has moved a point of the model.
dvec3 jitterOf(const Body& body, int point);

// Whether a target names the body.
bool names(const std::string& target, const Body& body);
// The bodies that a target names.
std::vector<Body*> matchBodies(std::span<Body* const> bodies, const std::string& target);

std::vector<Body*> pointersTo(std::vector<Body>& bodies);

// The surfaces that touch others separately: the parts of a rigid body; any other body has one, with the thickness of
// its spec.
std::vector<mechanics::RigidPart> surfacesOf(const Body& body);

// [m] Shortest edge at the start of the triangles that other bodies touch, or of structural springs if there are none.
// Infinite if there are no edges.
double shortestEdge(const Body& body);
double longestEdge(const Body& body);  // [m] at rest; 0 if there are no edges

}  // namespace taut::world
