#include "taut/advice/figures.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "taut/spec/spec.h"

namespace taut::world {
namespace {

std::string textOf(const ColliderSpec& collider) {
    const figure::Figure& figure = *collider.meshData->figure;
    std::vector<std::string> animations, joints;
    for (const figure::Animation& animation : figure.animations)
        animations.push_back(fmt::format("\"{}\" ({:.3g} s)", animation.name, animation.seconds));
    std::set<int> known;
    for (const figure::Skin& skin : figure.skins)
        for (const int joint : skin.joints)
            if (const std::string& name = figure.nodes[joint].name; !name.empty() && known.insert(joint).second)
                joints.push_back(name);
    std::string text = fmt::format("collider.{}: {} has {} triangles", collider.name,
                                   std::filesystem::path(collider.mesh).filename().string(), figure.triangles.size());
    if (!animations.empty()) text += fmt::format("; animations {}", fmt::join(animations, ", "));
    if (!joints.empty()) text += fmt::format("; joints {}", fmt::join(joints, ", "));
    if (!collider.meshData->notes.empty())
        text += fmt::format("; not read: {}", fmt::join(collider.meshData->notes, ", "));
    return text;
}

bool hasFigure(const SceneSpec& scene, const ColliderSpec& collider) {
    return scene.isFigure(collider) && collider.meshData != nullptr && collider.meshData->figure != nullptr;
}

}  // namespace

std::vector<core::Finding> figureDoubts(const SceneSpec& scene) {
    std::vector<core::Finding> doubts;
    for (const ColliderSpec& collider : scene.colliders)
        if (hasFigure(scene, collider) && collider.meshData->figure->skins.empty() &&
            collider.meshData->figure->animations.empty())
            doubts.push_back(warningAt(collider.source) +
                             fmt::format("collider.{}: {} has neither a skin nor an animation: it never moves, and "
                                         "shape = \"mesh\" costs less",
                                         collider.name, std::filesystem::path(collider.mesh).filename().string()));
    return doubts;
}

std::vector<std::string> figureNotes(const SceneSpec& scene) {
    std::vector<std::string> notes;
    for (const ColliderSpec& collider : scene.colliders)
        if (hasFigure(scene, collider)) notes.push_back(textOf(collider));
    return notes;
}

}  // namespace taut::world
