// Report of a world about its bodies, points and joints. It does not know the world.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace taut::world {

struct Body;

// The points of a target at a published tick, velocities synchronised: body by body, in the order of authoring.
struct PointsNow {
    std::vector<glm::dvec3> x, v;  // (points) [m], [m/s]
    std::vector<double> mass;      // (points) [kg]
};

// The points that KIND.NAME@SELECTOR names in a world; all points without @SELECTOR. World::select() finds them once
// for many queries.
struct Selection {
    struct Part {
        const Body* body;
        std::vector<int> points;  // of the body's model
    };
    std::vector<Part> parts;      // in the order of the state hash
    std::int64_t generation = 0;  // of the world's bodies
};

// A body's part of the state hash, which shows which bodies differ.
struct BodyHash {
    std::string name;  // "cloth.flag"
    std::uint64_t hash = 0;
};

// The two sides of a joint of the scene.
struct JointInfo {
    std::string a, b;  // points, as the scene names them
    std::string name;  // empty: none
    std::string kind;  // "weld"
    int number = 0;    // in the scene
    struct Pair {
        std::string a, b;  // "block.plank0"; b may be a collider
        int points = 0;    // of the first body that are tied to the second
    };
    std::vector<Pair> pairs;
    int left = 0;                    // number of points that it still ties
    double jump = 0;                 // [m] of points that it holds in one place: largest distance before
    std::vector<std::string> loose;  // bodies that it names but does not tie
};

}  // namespace taut::world
