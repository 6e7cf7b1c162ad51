// Figures built in code, for tests.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/figure/figure.h"
#include "taut/spec/collider_spec.h"

namespace taut::support {

// Level plates of n x n cells with edges of 1 m about the origin, each a node of its own: "plate0", "plate1", …, which
// stand at `places` [m].
inline figure::Figure plates(const std::vector<glm::dvec3>& places, int n) {
    figure::Figure figure;
    for (std::size_t p = 0; p < places.size(); ++p) {
        const int first = figure.vertexCount();
        figure::Node node;
        node.name = "plate" + std::to_string(p);
        node.translation = places[p];
        figure.nodes.push_back(node);
        figure::Part part;
        part.node = static_cast<int>(p);
        for (int k = 0; k <= n; ++k)
            for (int i = 0; i <= n; ++i)
                part.positions.emplace_back(static_cast<double>(i) / n - 0.5, 0.0, static_cast<double>(k) / n - 0.5);
        for (int k = 0; k < n; ++k)
            for (int i = 0; i < n; ++i) {
                const int a = first + k * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
                figure.triangles.push_back({a, c, d});
                figure.triangles.push_back({a, d, b});
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
    animation.channels.push_back(
        {node, path, figure::Interpolation::linear, std::move(times), std::move(values)});
}

// collider.f
inline world::ColliderSpec colliderOf(const figure::Figure& figure) {
    auto mesh = std::make_shared<world::MeshData>();
    mesh->positions.resize(static_cast<std::size_t>(figure.vertexCount()));
    figure::placeVertices(figure, figure::postureAt(figure, nullptr, 0), mesh->positions);
    mesh->triangles = figure.triangles;
    mesh->figure = std::make_shared<const figure::Figure>(figure);
    world::ColliderSpec collider;
    collider.name = "f";
    collider.shape = "figure";
    collider.mesh = "plates.glb";
    collider.meshData = mesh;
    if (!figure.animations.empty()) collider.animation = "move";
    collider.loops = false;
    return collider;
}

}  // namespace taut::support
