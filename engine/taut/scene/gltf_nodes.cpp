#include "taut/scene/private/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <utility>

namespace taut::scene {

using figure::Figure;

namespace {

constexpr std::size_t maxNodes = 100'000;

figure::Skin skinOf(const GltfModel& gltf, const GltfNodes& nodes, const tinygltf::Skin& from) {
    figure::Skin skin;
    for (const int joint : from.joints) {
        gltf.at(gltf.content().nodes, joint, "node");
        skin.joints.push_back(nodes.numberOf[joint]);
    }
    skin.inverseBind.assign(skin.joints.size(), glm::dmat4(1.0));
    if (from.inverseBindMatrices >= 0) {
        const GltfNumbers matrices = gltf.numbers(from.inverseBindMatrices, 16, "an inverse bind matrix");
        if (matrices.count() < skin.joints.size()) gltf.fail("a skin has fewer matrices than joints");
        for (std::size_t j = 0; j < skin.joints.size(); ++j) skin.inverseBind[j] = glm::make_mat4(matrices[j].data());
    }
    return skin;
}

void readAnimation(const tinygltf::Animation& from, GltfModel& gltf, const GltfNodes& nodes, Figure& figure) {
    static const std::map<std::string, figure::Path> paths{{"translation", figure::Path::translation},
                                                           {"rotation", figure::Path::rotation},
                                                           {"scale", figure::Path::scale},
                                                           {"weights", figure::Path::weights}};
    static const std::map<std::string, figure::Interpolation> ways{{"", figure::Interpolation::linear},
                                                                   {"LINEAR", figure::Interpolation::linear},
                                                                   {"STEP", figure::Interpolation::step},
                                                                   {"CUBICSPLINE", figure::Interpolation::cubic}};
    figure::Animation animation;
    animation.name = from.name.empty() ? std::to_string(figure.animations.size()) : from.name;
    for (const tinygltf::AnimationChannel& of : from.channels) {
        const auto path = paths.find(of.target_path);
        if (path == paths.end() || of.target_node < 0) {
            gltf.note(fmt::format("animation \"{}\" moves \"{}\"", animation.name, of.target_path));
            continue;
        }
        const tinygltf::AnimationSampler& sampler = gltf.at(from.samplers, of.sampler, "sampler");
        const auto way = ways.find(sampler.interpolation);
        if (way == ways.end()) gltf.fail(fmt::format("there is no interpolation \"{}\"", sampler.interpolation));
        gltf.at(gltf.content().nodes, of.target_node, "node");
        figure::Channel channel;
        channel.node = nodes.numberOf[of.target_node];
        channel.path = path->second;
        channel.interpolation = way->second;
        figure::Node& node = figure.nodes[channel.node];
        if (node.matrix) gltf.fail(fmt::format("animation \"{}\" moves a node that has a matrix", animation.name));
        const std::size_t width = channel.path == figure::Path::weights    ? node.weights.size()
                                  : channel.path == figure::Path::rotation ? 4
                                                                           : 3;
        channel.times = gltf.numbers(sampler.input, 1, "a time").values;
        const bool isScalar = channel.path == figure::Path::weights;
        channel.values = gltf.numbers(sampler.output, isScalar ? 1 : width, "a key").values;
        const std::size_t perKey = width * (channel.interpolation == figure::Interpolation::cubic ? 3 : 1);
        if (width == 0 || channel.times.empty() || channel.values.size() != channel.times.size() * perKey)
            gltf.fail(fmt::format("animation \"{}\" has {} times and {} numbers for {} of \"{}\"", animation.name,
                                  channel.times.size(), channel.values.size(), of.target_path, node.name));
        for (std::size_t k = 1; k < channel.times.size(); ++k)
            if (!(channel.times[k] > channel.times[k - 1]))
                gltf.fail(fmt::format("animation \"{}\": times do not ascend", animation.name));
        animation.seconds = std::max(animation.seconds, channel.times.back());
        animation.channels.push_back(std::move(channel));
    }
    figure.animations.push_back(std::move(animation));
}

}  // namespace

GltfNodes readGltfNodes(const GltfModel& gltf, Figure& figure) {
    GltfNodes nodes;
    auto& [isDrawn, numberOf] = nodes;
    const std::size_t count = gltf.content().nodes.size();
    if (count > maxNodes) gltf.fail(fmt::format("{} nodes; {} at most", count, maxNodes));
    std::vector<int> parent(count, -1);
    for (std::size_t n = 0; n < count; ++n)
        for (const int child : gltf.content().nodes[n].children) {
            gltf.at(gltf.content().nodes, child, "node");
            if (parent[child] >= 0) gltf.fail(fmt::format("node {} has two parents", child));
            parent[child] = static_cast<int>(n);
        }
    isDrawn.assign(count, gltf.content().scenes.empty());
    if (!gltf.content().scenes.empty())
        for (const int root : gltf.at(gltf.content().scenes, std::max(0, gltf.content().defaultScene), "scene").nodes) {
            gltf.at(gltf.content().nodes, root, "node");
            isDrawn[root] = true;
        }
    numberOf.assign(count, -1);
    std::vector<int> order;
    for (std::size_t n = 0; n < count; ++n)
        if (parent[n] < 0) order.push_back(static_cast<int>(n));
    for (std::size_t next = 0; next < order.size(); ++next)
        for (const int child : gltf.content().nodes[order[next]].children) order.push_back(child);
    if (order.size() < count) gltf.fail("nodes are parents of their parents");
    for (const int number : order) {
        const auto n = static_cast<std::size_t>(number);
        const tinygltf::Node& from = gltf.content().nodes[n];
        figure::Node node;
        node.name = from.name;
        if (parent[n] >= 0) {
            node.parent = numberOf[parent[n]];
            isDrawn[n] = isDrawn[n] || isDrawn[parent[n]];
        }
        for (const auto* list : {&from.translation, &from.rotation, &from.scale, &from.matrix, &from.weights})
            for (const double v : *list)
                if (!(std::abs(v) <= GltfModel::maxPlace))
                    gltf.fail(fmt::format("node {} has a number that is not finite", number));
        const auto sized = [&](const std::vector<double>& list, std::size_t size) {
            if (!list.empty() && list.size() != size)
                gltf.fail(fmt::format("node {} has {} numbers where {} belong", number, list.size(), size));
            return !list.empty();
        };
        if (sized(from.translation, 3)) node.translation = glm::make_vec3(from.translation.data());
        if (sized(from.scale, 3)) node.scale = glm::make_vec3(from.scale.data());
        if (sized(from.matrix, 16)) node.matrix = glm::make_mat4(from.matrix.data());
        if (sized(from.rotation, 4)) {
            const glm::dquat q(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
            if (!(glm::dot(q, q) > 0)) gltf.fail(fmt::format("node {} has no rotation", number));
            node.rotation = glm::normalize(q);
        }
        node.weights = from.weights;
        numberOf[n] = static_cast<int>(figure.nodes.size());
        figure.nodes.push_back(std::move(node));
    }
    return nodes;
}

void readGltfSkins(const GltfModel& gltf, const GltfNodes& nodes, Figure& figure) {
    for (const tinygltf::Skin& skin : gltf.content().skins) figure.skins.push_back(skinOf(gltf, nodes, skin));
}

void readGltfAnimations(GltfModel& gltf, const GltfNodes& nodes, Figure& figure) {
    for (const tinygltf::Animation& animation : gltf.content().animations)
        readAnimation(animation, gltf, nodes, figure);
}

}  // namespace taut::scene
