// A rope, cloth, block or net of the scene: its model, and where its points live in an island.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "taut/mechanics/model.h"
#include "taut/world/damage.h"
#include "taut/world/spec.h"

namespace taut::world {

class Island;

struct Body {
    enum class Kind { block, cloth, net, rope };  // the order of the state hash
    Kind kind = Kind::cloth;
    std::string name;  // "flag", or "flag.2" in an array
    std::string base;  // "flag"
    BodySpec common;   // what every kind has
    mechanics::Model model;

    double radius = 0;         // [m] rope, net: of the tube
    double ball = 0;           // [m] net: of a point
    double workingStretch = 1; // block
    PlasticitySpec plasticity;

    Damage damage;  // what has been cut or torn of it

    // In the island that owns it.
    Island* island = nullptr;
    std::vector<int> pointOf;            // (points) number in the island, for each point of the model
    int firstPoint = 0, lastPoint = 0;   // the range that collides for this body

    std::string fullName() const;  // "cloth.flag"
};

std::string_view kindName(Body::Kind kind);

// All bodies of the scene with arrays expanded, held points set, masses added and starting velocities given; sorted
// by kind and name. Throws core::Error(badContent) naming file, line and column.
std::vector<Body> buildBodies(const SceneSpec& spec);

// The order of the state hash: by kind and name, row.2 before row.10.
bool sortsBefore(const Body& a, const Body& b);

// One body of each kind, for spawning: at rest and free, arrays not expanded; startBody does the rest.
Body buildBody(const ClothSpec& spec, const std::map<std::string, MaterialSpec>& materials);
Body buildBody(const RopeSpec& spec);
Body buildBody(const BlockSpec& spec);
Body buildBody(const NetSpec& spec);

// Holds the points that its spec names and gives the others their starting velocity and jitter. Throws
// core::Error(badContent) where `hold` names nothing.
void startBody(Body& body);

// "file:line:column: error: " of a source, or less when it has none.
std::string at(const Source& source);

// Whether a target names the body.
bool names(const std::string& target, const Body& body);
// The bodies that a target names.
std::vector<Body*> matchBodies(std::span<Body* const> bodies, const std::string& target);

std::vector<Body*> pointersTo(std::vector<Body>& bodies);

}  // namespace taut::world
