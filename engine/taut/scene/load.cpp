#include "taut/scene/load.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/error.h"
#include "taut/joints/sewn_panels.h"
#include "taut/scene/private/asset_files.h"
#include "taut/scene/private/body_size.h"
#include "taut/scene/private/claims.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/fabrics.h"
#include "taut/scene/private/fit_keys.h"
#include "taut/scene/private/inheritance.h"
#include "taut/scene/private/measured_curves.h"
#include "taut/scene/private/merge.h"
#include "taut/scene/private/overrides.h"
#include "taut/scene/private/references.h"
#include "taut/scene/private/scene_reader.h"
#include "taut/scene/private/suspicions.h"
#include "taut/scene/private/text_file.h"
#include "taut/scene/private/timeline.h"
#include "taut/scene/state_keys.h"

namespace taut::scene {

namespace {

constexpr std::uint64_t maxSceneSize = 16U << 20U;  // [bytes]

void throwIfAny(const Problems& problems) {
    if (problems.errorCount() > 0) throw core::Error(core::ErrorKind::badContent, problems.errors());
}

// Refuses a scene that is too large, where its bodies take less than half of it.
void addTooLarge(const ReadScene& scene, const SceneSize& size, double limit, Problems& problems) {
    constexpr double gigabyte = 1e9;
    const bool isPicture = size.pictures > size.colliders;
    const Place place = isPicture || scene.spec.colliders.empty()
                            ? Place{.line = 1, .column = 1}
                            : scene.owners.at("collider." + scene.spec.colliders.front().name);
    problems.addError(
        place,
        fmt::format("the scene is too large: {:.4g} GB for colliders, {:.4g} GB for pictures of {} x {} "
                    "pixels, {:.4g} GB for the rest; the limit is {:.4g} GB",
                    size.colliders / gigabyte, size.pictures / gigabyte, scene.spec.picture.size.x,
                    scene.spec.picture.size.y, (size.bodies + size.timeline) / gigabyte, limit / gigabyte),
        isPicture ? "give picture a smaller size, fewer samples or a smaller shadow_size"
                  : "give it fewer colliders, or visible = false where they need not be seen");
}

// Refuses a scene that is too large, at the body that takes most.
void checkSize(const ReadScene& scene, double limit, Problems& problems) {
    const SceneSize whole = wholeSizeOf(scene.spec);
    const BodySize total = sizeOf(scene.spec);
    const double bytes = whole.bytes();
    if (bytes <= limit && total.points <= maxPoints) return;
    if (whole.bodies < 0.5 * bytes) return addTooLarge(scene, whole, limit, problems);
    double largest = 0;
    std::string largestTitle;
    for (const world::BodySpec& body : scene.spec.bodies) {
        const double size = sizeOf(body, scene.spec).bytes();
        if (size <= largest) continue;
        largest = size;
        largestTitle = body.fullName();
    }
    constexpr double gigabyte = 1e9;
    problems.addError(scene.owners.at(largestTitle),
                      fmt::format("the scene is too large: {:.4g} points and {:.4g} springs need about {:.4g} GB; "
                                  "the limit is {:.4g} points and {:.4g} GB",
                                  total.points, total.springs, bytes / gigabyte, maxPoints, limit / gigabyte),
                      fmt::format("{} is the largest: give it fewer cells, segments or copies", largestTitle));
}

template <class Element>
void sortByName(std::vector<Element>& elements) {
    std::sort(
        elements.begin(), elements.end(), [](const Element& a, const Element& b) { return a.name < b.name; });
}

// By kind in the order of the table, then by name.
template <class Base>
void sortByKind(world::Specs<Base>& specs, const world::KindTable<Base>& kinds) {
    specs.stableSort([&](const Base& a, const Base& b) {
        const auto *x = kinds.find(a.kind()), *y = kinds.find(b.kind());
        return x != y ? x < y : a.name < b.name;
    });
}

void sortByName(world::SceneSpec& spec, const world::Kinds& kinds) {
    sortByKind(spec.bodies, kinds.bodies);
    sortByKind(spec.forces, kinds.forces);
    sortByName(spec.colliders);
    sortByName(spec.cameras);
    sortByName(spec.lamps);
    sortByName(spec.labels);
    spec.actions.stableSort([](const world::ActionSpec& a, const world::ActionSpec& b) { return a.t < b.t; });
}

void checkLights(const ReadScene& scene, Problems& problems) {
    for (std::size_t i = world::mostLamps; i < scene.spec.lamps.size(); ++i)
        problems.addError(scene.owners.at("lamp." + scene.spec.lamps[i].name),
                          fmt::format("a scene has three lights at most: the sun and {} lamps", world::mostLamps),
                          "leave out a lamp");
}

Confinement confinementOf(const std::string& fileName, const LoadOptions& options) {
    if (!options.isConfined) return {};
    Confinement confinement{options.assetFolders};
    confinement.folders.push_back(std::filesystem::path(fileName).parent_path());
    return confinement;
}

// Merges the document into the scene that it names, and so on down the chain. Returns the names of these scenes, the
// nearest first.
std::vector<std::string> layOnBases(Node& root, const std::string& fileName, const LoadOptions& options,
                                    Problems& problems) {
    std::vector<std::filesystem::path> chain{fileName};
    std::vector<Node> trees;
    std::vector<std::string> bases;
    while (true) {
        BaseFile base = baseFileOf(trees.empty() ? root : trees.back(), chain, options.assetFolders,
                                   confinementOf(fileName, options), maxSceneSize, problems);
        throwIfAny(problems);
        if (base.path.empty()) break;
        chain.push_back(base.path);
        bases.push_back(base.path.string());
        trees.push_back(treeOf(base.text, problems.addBase(base.text, base.path.string()), problems));
    }
    if (trees.empty()) return {};
    // From the lowest up, as each was written for the ones below it.
    Node sum = std::move(trees.back());
    for (auto over = trees.rbegin() + 1; over != trees.rend(); ++over) sum = merged(std::move(sum), *over);
    root = merged(std::move(sum), root);
    return bases;
}

}  // namespace

Loaded loadScene(const std::filesystem::path& path, const LoadOptions& options) {
    if (!confinementOf(path.string(), options).allows(path))
        throw core::Error(core::ErrorKind::badContent, core::at({path.string()}) + outsideMessage(path));
    return loadSceneText(textFile(path, maxSceneSize), path.string(), options);
}

Loaded loadSceneText(std::string_view text, const std::string& fileName, const LoadOptions& options) {
    std::vector<std::string> labels;
    for (const std::string& override : options.overrides) labels.push_back(overrideLabel(override));
    Problems problems(text, fileName, labels);
    const world::Kinds kinds = options.kinds ? *options.kinds : world::builtIn();

    Node root = treeOf(text, 0, problems);
    std::vector<std::string> bases = layOnBases(root, fileName, options, problems);
    const std::vector<SceneSection> sections = sceneSections(kinds);
    for (std::size_t i = 0; i < options.overrides.size(); ++i)
        applyOverride(options.overrides[i], static_cast<int>(i) + 1, sections, root, problems);
    if (const Member* member = root.find("scene"); member != nullptr && member->value.place.origin > 0)
        problems.addError(member->value.place, "the scene that a file builds on cannot be set");
    std::vector<std::string> fabrics = addFabrics(options.assetFolders, root, problems);
    inherit(sections, root, problems);
    ReadScene scene = readScene(root, sections, fileName, problems);
    scene.spec.shapes = std::make_shared<const collision::ShapeKinds>(kinds.shapes);
    scene.spec.bases = std::move(bases);
    scene.spec.fabrics = std::move(fabrics);
    loadAssets(options, confinementOf(fileName, options), scene, problems);
    world::meetFigures(scene.spec);
    const BodyIndex bodies(scene.spec, kinds, scene.faulty);
    checkReferences(scene, bodies, problems);
    checkTimeline(root, sections, bodies, scene, problems);
    readCurves(root, confinementOf(fileName, options), scene, problems);
    checkClaims(root, bodies, scene, problems);
    checkFitKeys(root, sections, scene, problems);
    checkLights(scene, problems);
    throwIfAny(problems);
    checkSize(scene, options.memoryLimit > 0 ? options.memoryLimit : memoryLimit(), problems);
    throwIfAny(problems);
    world::evenSeams(scene.spec);

    reportSuspicions(scene, problems);
    sortByName(scene.spec, kinds);
    scene.spec.solver.methods = std::make_shared<const ode::Methods>(kinds.methods);
    scene.spec.actionKinds = std::make_shared<const world::KindTable<world::ActionSpec>>(kinds.actions);
    StateKeys keys(root, scene.spec);
    return {std::move(scene.spec), problems.warnings(), std::move(keys),
            std::make_shared<const ActionReader>(std::move(root), kinds)};
}

std::string targetFault(const world::SceneSpec& scene, const std::string& target, bool mayHavePoints,
                        const std::string& against) {
    const BodyIndex bodies(scene, world::builtIn(), {});
    auto fault = mayHavePoints ? bodies.targetFault(target) : bodies.bodyFault(target);
    if (!fault && !against.empty()) fault = bodies.betweenFault(against, target);
    if (!fault) return {};
    return fault->message + (fault->remedy.empty() ? "" : "; " + fault->remedy);
}

std::string jointFault(const world::SceneSpec& scene, const std::string& name) {
    const auto fault = nameFault(scene, name);
    if (!fault) return {};
    return fault->message + (fault->remedy.empty() ? "" : "; " + fault->remedy);
}

}  // namespace taut::scene
