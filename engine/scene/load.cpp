#include "taut/scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/scene/asset_files.h"
#include "taut/scene/body_size.h"
#include "taut/scene/claims.h"
#include "taut/scene/document.h"
#include "taut/scene/merge.h"
#include "taut/scene/overrides.h"
#include "taut/scene/references.h"
#include "taut/scene/scene_reader.h"
#include "taut/scene/state_keys.h"
#include "taut/scene/suspicions.h"
#include "taut/scene/text_file.h"
#include "taut/scene/timeline.h"
#include "taut/world/each_body.h"

namespace taut::scene {

namespace {

constexpr std::uint64_t maxSceneSize = 16U << 20U;  // [bytes]

void throwIfAny(const Problems& problems) {
    if (problems.errorCount() > 0) throw core::Error(core::ExitCode::badContent, problems.errors());
}

// Refuses a scene that asks for too much, at the body that asks for most.
void checkSize(const ReadScene& scene, double limit, Problems& problems) {
    const BodySize total = sizeOf(scene.spec);
    const double bytes = total.bytes();
    if (bytes <= limit && total.points <= maxPoints) return;
    double largest = 0;
    std::string largestTitle;
    forEachBody(scene.spec, [&](const char* kind, const auto& body) {
        if (sizeOf(body).bytes() <= largest) return;
        largest = sizeOf(body).bytes();
        largestTitle = fmt::format("{}.{}", kind, body.name);
    });
    constexpr double gigabyte = 1e9;
    problems.addError(scene.owners.at(largestTitle),
                      fmt::format("the scene is too large: {:.4g} points and {:.4g} springs need about {:.4g} GB; "
                                  "the limit is {:.4g} points and {:.4g} GB",
                                  total.points, total.springs, bytes / gigabyte, maxPoints, limit / gigabyte),
                      fmt::format("{} is the largest: give it fewer cells, segments or copies", largestTitle));
}

template <class Element>
void sortByName(std::vector<Element>& elements) {
    std::sort(elements.begin(), elements.end(), [](const Element& a, const Element& b) { return a.name < b.name; });
}

void sortByName(world::SceneSpec& spec) {
    sortByName(spec.cloths);
    sortByName(spec.ropes);
    sortByName(spec.blocks);
    sortByName(spec.nets);
    sortByName(spec.anchors);
    sortByName(spec.colliders);
    sortByName(spec.winds);
    sortByName(spec.cameras);
    sortByName(spec.labels);
    std::stable_sort(spec.actions.begin(), spec.actions.end(),
                     [](const world::ActionSpec& a, const world::ActionSpec& b) { return a.t < b.t; });
}

Node treeOf(std::string_view text, int origin, Problems& problems) {
    try {
        return documentTree(text, origin);
    } catch (const SyntaxError& error) {
        problems.addError(error.place, error.what());
        throw core::Error(core::ExitCode::badContent, problems.errors());
    }
}

// Lays the document over the scene that it names, if it names one, and says which.
std::filesystem::path layOnBase(Node& root, const std::string& fileName, const LoadOptions& options,
                                Problems& problems) {
    BaseFile base = baseFileOf(root, fileName, options.assetFolders, maxSceneSize, problems);
    throwIfAny(problems);
    if (base.path.empty()) return {};
    problems.setBase(base.text, base.path.string());
    Node below = treeOf(base.text, -1, problems);
    if (const Member* scene = below.find("scene")) {
        problems.addError(scene->place, "a scene that another builds on must not build on a third",
                          "name that one in the first file");
        throwIfAny(problems);
    }
    root = merged(std::move(below), root);
    return base.path;
}

}  // namespace

Loaded loadScene(const std::filesystem::path& path, const LoadOptions& options) {
    return loadSceneText(textFile(path, maxSceneSize), path.string(), options);
}

Loaded loadSceneText(std::string_view text, const std::string& fileName, const LoadOptions& options) {
    std::vector<std::string> labels;
    for (const std::string& override : options.overrides) labels.push_back(overrideLabel(override));
    Problems problems(text, fileName, labels);

    Node root = treeOf(text, 0, problems);
    const std::filesystem::path base = layOnBase(root, fileName, options, problems);
    const std::vector<SceneSection> sections = sceneSections();
    for (std::size_t i = 0; i < options.overrides.size(); ++i) {
        applyOverride(options.overrides[i], static_cast<int>(i) + 1, sections, root, problems);
    }
    if (const Member* member = root.find("scene"); member != nullptr && member->value.place.origin > 0)
        problems.addError(member->value.place, "the scene that a file builds on cannot be set");
    ReadScene scene = readScene(root, sections, fileName, problems);
    scene.spec.base = base.string();
    loadAssets(std::filesystem::path(fileName).parent_path(), base.parent_path(), options.assetFolders, scene,
               problems);
    checkReferences(scene, problems);
    checkTimeline(root, sections, scene, problems);
    checkClaims(root, scene, problems);
    throwIfAny(problems);
    checkSize(scene, options.memoryLimit > 0 ? options.memoryLimit : memoryLimit(), problems);
    throwIfAny(problems);

    reportSuspicions(scene, problems);
    sortByName(scene.spec);
    StateKeys keys(root, scene.spec);
    return {std::move(scene.spec), problems.warnings(), std::move(keys)};
}

}  // namespace taut::scene
