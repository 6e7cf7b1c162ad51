// The facts that every drawn mesh must satisfy, for the tests of the shapes and of the tube.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "taut/view/frame_view.h"

namespace taut::view::test {

// Edges that do not have exactly one triangle on each side, with vertices at the same place taken as one.
inline int openEdges(const Topology& topology, const Geometry& geometry) {
    std::map<std::tuple<float, float, float>, int> places;
    std::vector<int> place;
    for (const glm::vec3& p : geometry.positions) {
        const auto key = std::make_tuple(p.x + 0.0F, p.y + 0.0F, p.z + 0.0F);
        place.push_back(places.emplace(key, static_cast<int>(places.size())).first->second);
    }
    std::map<std::pair<int, int>, int> edges;
    for (std::size_t i = 0; i < topology.triangles.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = place[topology.triangles[i + k]];
            const int b = place[topology.triangles[i + (k + 1) % 3]];
            ++edges[{a, b}];
        }
    }
    int open = 0;
    for (const auto& [edge, uses] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        if (uses != 1 || back == edges.end() || back->second != 1) ++open;
    }
    return open;
}

// The largest deviation of a normal's length from 1.
inline float normalLengthError(const Geometry& geometry) {
    float worst = 0.0F;
    for (const glm::vec3& n : geometry.normals) worst = glm::max(worst, glm::abs(glm::length(n) - 1.0F));
    return worst;
}

// The smallest cosine between a triangle's own direction and the normals at its corners.
inline float leastAgreement(const Topology& topology, const Geometry& geometry) {
    float least = 1.0F;
    for (std::size_t i = 0; i < topology.triangles.size(); i += 3) {
        const auto* t = &topology.triangles[i];
        const auto& p = geometry.positions;
        const glm::vec3 area = glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
        for (int k = 0; k < 3; ++k) least = glm::min(least, glm::dot(glm::normalize(area), geometry.normals[t[k]]));
    }
    return least;
}

// Six times the enclosed volume is the sum of the corners' triple products.
inline float volume(const Topology& topology, const Geometry& geometry) {
    float sum = 0.0F;
    for (std::size_t i = 0; i < topology.triangles.size(); i += 3) {
        const auto* t = &topology.triangles[i];
        const auto& p = geometry.positions;
        sum += glm::dot(p[t[0]], glm::cross(p[t[1]], p[t[2]]));
    }
    return sum / 6.0F;
}

}  // namespace taut::view::test
