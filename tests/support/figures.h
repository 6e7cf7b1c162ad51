// Figures built in code, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "taut/figure/figure.h"
#include "taut/spec/collider_spec.h"

namespace taut::support {

// Boxes of this size [m], their faces n x n cells, each a node of its own: "box0", "box1", …, which stand at `places`.
inline figure::Figure boxes(const std::vector<glm::dvec3>& places, const glm::dvec3& size, int n) {
    figure::Figure figure;
    for (std::size_t p = 0; p < places.size(); ++p) {
        const int first = figure.vertexCount();
        figure::Node node;
        node.name = "box" + std::to_string(p);
        node.translation = places[p];
        figure.nodes.push_back(node);
        figure::Part part;
        part.node = static_cast<int>(p);
        std::map<std::array<int, 3>, int> known;
        const auto vertex = [&](const std::array<int, 3>& at) {
            const auto [found, isNew] = known.try_emplace(at, first + static_cast<int>(part.positions.size()));
            if (isNew)
                part.positions.push_back(size * (glm::dvec3(at[0], at[1], at[2]) / static_cast<double>(n) - 0.5));
            return found->second;
        };
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int side : {0, n})
                for (int i = 0; i < n; ++i)
                    for (int k = 0; k < n; ++k) {
                        const auto corner = [&](int di, int dk) {
                            std::array<int, 3> at{};
                            at[axis] = side;
                            at[(axis + 1) % 3] = i + di;
                            at[(axis + 2) % 3] = k + dk;
                            return vertex(at);
                        };
                        int b = corner(1, 0), d = corner(0, 1);
                        if (side == 0) std::swap(b, d);  // the front of every face is outside
                        figure.triangles.push_back({corner(0, 0), b, corner(1, 1)});
                        figure.triangles.push_back({corner(0, 0), corner(1, 1), d});
                    }
        figure.parts.push_back(part);
    }
    return figure;
}

// Node `node` goes through these keys, values as glTF orders them.
inline void animate(figure::Figure& figure, int node, figure::Path path, std::vector<double> times,
                    std::vector<double> values) {
    if (figure.animations.empty()) figure.animations.push_back({"move", 0, {}});
    figure::Animation& animation = figure.animations.front();
    animation.seconds = std::max(animation.seconds, times.back());
    animation.channels.push_back({node, path, figure::Interpolation::linear, std::move(times), std::move(values)});
}

// collider.f
inline world::ColliderSpec colliderOf(const figure::Figure& figure) {
    auto mesh = std::make_shared<world::MeshData>();
    mesh->positions.resize(figure.vertexCount());
    figure::placeVertices(figure, figure::postureAt(figure, nullptr, 0), mesh->positions);
    mesh->triangles = figure.triangles;
    mesh->figure = std::make_shared<const figure::Figure>(figure);
    world::ColliderSpec collider;
    collider.name = "f";
    collider.shape = "figure";
    collider.mesh = "boxes.glb";
    collider.meshData = mesh;
    if (!figure.animations.empty()) collider.animation = "move";
    collider.loops = false;
    return collider;
}

}  // namespace taut::support
