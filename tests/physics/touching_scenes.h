// Scenes of bodies that touch, for several tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "support/piercings.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/bodies/rope.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"

namespace taut::test::touching {

constexpr double g = 9.81;      // [m/s²]
constexpr double keep = 0.008;  // [m] that two sheets keep

// Double precision, steps as "auto" finds them; linen of 0.2 kg/m² and 200 N/m without drag.
inline world::SceneSpec scene(double friction = 0.3) {
    world::SceneSpec spec;
    spec.solver.precision = world::Precision::double_;
    spec.contact.friction = friction;
    world::MaterialSpec linen;
    linen.stretch = 200.0;
    linen.bend = 0.2;
    linen.dampingTime = 1e-3;
    linen.drag = 0.0;
    spec.materials["linen"] = linen;
    return spec;
}

// cells along the longer side, squares.
inline world::ClothSpec sheet(const std::string& name, const dvec3& origin, const dvec3& across, const dvec3& down,
                              int cells) {
    world::ClothSpec cloth;
    cloth.name = name;
    cloth.material = "linen";
    cloth.origin = origin;
    cloth.size = {glm::length(across), glm::length(down)};
    cloth.across = glm::normalize(across);
    cloth.down = glm::normalize(down);
    const double cell = std::max(cloth.size.x, cloth.size.y) / cells;
    cloth.cells = {static_cast<int>(std::lround(cloth.size.x / cell)),
                   static_cast<int>(std::lround(cloth.size.y / cell))};
    cloth.thickness = keep / 2;
    cloth.touch = world::Touch::all;
    return cloth;
}

inline world::ColliderSpec ground(double height, double friction = 0.3) {
    world::ColliderSpec plane;
    plane.name = "ground";
    plane.shape = "plane";
    plane.position = {0.0, height, 0.0};
    plane.friction = friction;
    return plane;
}

inline double largestDifference(const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::distance(a[i], b[i]));
    return most;
}

// Of the fastest of their points, by their ways in a tick and not by velocities. [m/s]
inline double fastest(world::World& world, const std::vector<std::string>& bodies) {
    std::vector<std::vector<dvec3>> before;
    for (const std::string& name : bodies) before.push_back(positionsOf(world, name));
    EXPECT_FALSE(world.advance());
    double most = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        most = std::max(most, largestDifference(before[b], positionsOf(world, bodies[b])) / world.tickSeconds());
    return most;
}

inline double meanAlong(const std::vector<dvec3>& x, const dvec3& direction) {
    double sum = 0;
    for (const dvec3& p : x) sum += glm::dot(p, direction);
    return sum / static_cast<double>(x.size());
}

// A torus about the vertical: the middle of its tube at `radius` from the axis.
inline world::ColliderSpec ring(double radius, double tube) {
    constexpr double turn = 2 * 3.14159265358979323846;
    constexpr int around = 32, across = 12;
    auto mesh = std::make_shared<world::MeshData>();
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double a = turn * i / around, b = turn * j / across, r = radius + tube * std::cos(b);
            mesh->positions.emplace_back(r * std::cos(a), tube * std::sin(b), r * std::sin(a));
            const auto at = [](int k, int l) { return (k % around) * across + l % across; };
            mesh->triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            mesh->triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    world::ColliderSpec collider;
    collider.name = "ring";
    collider.shape = "mesh";
    collider.meshData = mesh;
    collider.friction = 0.1;
    return collider;
}

}  // namespace taut::test::touching
