// Small scenes built in code, for tests of the world.
#pragma once

#include <string>

#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/joints/joints.h"
#include "taut/spec/spec.h"

namespace taut::support {

inline world::ClothSpec cloth(const std::string& name, int cells = 8) {
    world::ClothSpec spec;
    spec.name = name;
    spec.cells = {cells, cells};
    spec.origin = {0.0, 2.0, 0.0};
    return spec;
}

// Stiff, and held at its bottom.
inline world::BlockSpec stiffBlock(const std::string& name) {
    world::BlockSpec block;
    block.name = name;
    block.size = {0.2, 0.2, 0.2};
    block.cells = {4, 4, 4};
    block.density = 1000;
    block.young = 2e5;
    block.bulk = 2e6;
    block.hold = {"bottom"};
    return block;
}

inline world::RopeSpec rope(const std::string& name, world::dvec3 start, world::dvec3 end, int segments = 10) {
    world::RopeSpec spec;
    spec.name = name;
    spec.start = start;
    spec.end = end;
    spec.segments = segments;
    return spec;
}

inline world::ColliderSpec ball(const std::string& name, world::dvec3 position, double radius) {
    world::ColliderSpec spec;
    spec.name = name;
    spec.position = position;
    spec.radius = radius;
    return spec;
}

inline world::ColliderSpec ground() {
    world::ColliderSpec spec;
    spec.name = "ground";
    spec.shape = "plane";
    return spec;
}

inline world::WeldJoint weld(const std::string& a, const std::string& b, double reach = 0.02,
                             const world::Source& source = {}) {
    world::WeldJoint joint;
    joint.a = a;
    joint.b = b;
    joint.furthest = reach;
    joint.source = source;
    return joint;
}

inline world::SpringJoint springJoint(const std::string& a, const std::string& b, double stiffness,
                                      double dampingTime = 0) {
    world::SpringJoint joint;
    joint.a = a;
    joint.b = b;
    joint.stiffness = stiffness;
    joint.dampingTime = dampingTime;
    return joint;
}

}  // namespace taut::support
