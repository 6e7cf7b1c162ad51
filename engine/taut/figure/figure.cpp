#include "taut/figure/figure.h"

#include <algorithm>

namespace taut::figure {
namespace {

dmat4 localOf(const Node& node) {
    if (node.matrix) return *node.matrix;
    dmat4 local = glm::mat4_cast(node.rotation);
    for (int axis = 0; axis < 3; ++axis) local[axis] *= node.scale[axis];
    local[3] = glm::dvec4(node.translation, 1.0);
    return local;
}

void apply(const Channel& channel, double seconds, Node& node) {
    std::array<double, 4> v{};
    switch (channel.path) {
        case Path::translation:
            sample(channel, 3, seconds, v);
            node.translation = {v[0], v[1], v[2]};
            break;
        case Path::rotation:
            sample(channel, 4, seconds, v);
            node.rotation = dquat(v[3], v[0], v[1], v[2]);
            break;
        case Path::scale:
            sample(channel, 3, seconds, v);
            node.scale = {v[0], v[1], v[2]};
            break;
        case Path::weights: sample(channel, node.weights.size(), seconds, node.weights); break;
    }
}

}  // namespace

int Figure::vertexCount() const {
    std::size_t count = 0;
    for (const Part& part : parts) count += part.positions.size();
    return static_cast<int>(count);
}

const Animation* Figure::find(std::string_view animation) const {
    const auto found = std::find_if(animations.begin(), animations.end(),
                                    [&](const Animation& other) { return other.name == animation; });
    return found != animations.end() ? &*found : nullptr;
}

int Figure::nodeNamed(std::string_view name) const {
    const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) { return node.name == name; });
    return found != nodes.end() ? static_cast<int>(found - nodes.begin()) : -1;
}

Posture postureAt(const Figure& figure, const Animation* animation, double seconds) {
    std::vector<Node> nodes = figure.nodes;
    if (animation != nullptr)
        for (const Channel& channel : animation->channels) apply(channel, seconds, nodes[channel.node]);
    Posture posture;
    for (const Node& node : nodes) {
        const dmat4 local = localOf(node);
        posture.world.push_back(node.parent < 0 ? local : posture.world[node.parent] * local);
        posture.weights.push_back(node.weights);
    }
    return posture;
}

void placeVertices(const Figure& figure, const Posture& posture, std::span<dvec3> places) {
    std::size_t first = 0;
    std::vector<dmat4> joints;
    for (const Part& part : figure.parts) {
        const std::span<dvec3> own = places.subspan(first, part.positions.size());
        first += part.positions.size();
        std::copy(part.positions.begin(), part.positions.end(), own.begin());
        const std::vector<double>& weights = posture.weights[part.node];
        for (std::size_t t = 0; t < part.targets.size(); ++t)
            if (weights[t] != 0)
                for (std::size_t i = 0; i < own.size(); ++i) own[i] += weights[t] * part.targets[t][i];

        const dmat4& node = posture.world[part.node];
        if (part.skin < 0) {
            for (dvec3& x : own) x = dvec3(node * glm::dvec4(x, 1.0));
            continue;
        }
        const Skin& skin = figure.skins[part.skin];
        joints.clear();
        for (std::size_t j = 0; j < skin.joints.size(); ++j)
            joints.push_back(posture.world[skin.joints[j]] * skin.inverseBind[j]);
        for (std::size_t i = 0; i < own.size(); ++i) {
            dvec3 sum(0.0);
            for (std::size_t k = part.firstInfluence[i]; k < part.firstInfluence[i + 1]; ++k) {
                const Part::Influence& of = part.influences[k];
                sum += of.weight * dvec3(joints[of.joint] * glm::dvec4(own[i], 1.0));
            }
            own[i] = sum;
        }
    }
}

}  // namespace taut::figure
