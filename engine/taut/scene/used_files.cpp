#include "taut/scene/private/used_files.h"

#include <algorithm>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/hash.h"
#include "taut/core/whole_file.h"
#include "taut/spec/spec.h"

namespace taut::scene {
namespace {

std::uint64_t contentOf(const std::string& path) {
    constexpr std::uint64_t most = std::uint64_t{1} << 30U;  // [bytes] of a texture
    try {
        core::Hash hash;
        hash.add(core::fileContent(path, most));
        return hash.value();
    } catch (const core::Error&) {
        return 0;
    }
}

// Each once.
class Files {
  public:
    void add(const std::string& path) {
        const bool isKnown =
            std::any_of(files_.begin(), files_.end(), [&](const UsedFile& file) { return file.path == path; });
        if (!path.empty() && !isKnown) files_.push_back({path, contentOf(path)});
    }
    std::vector<UsedFile> take() { return std::move(files_); }

  private:
    std::vector<UsedFile> files_;
};

}  // namespace

std::vector<UsedFile> usedFiles(const world::SceneSpec& scene) {
    Files files;
    files.add(scene.file);
    for (const std::string& base : scene.bases) files.add(base);
    for (const std::string& fabric : scene.fabrics) files.add(fabric);
    files.add(scene.run.start);
    files.add(scene.environment.image);
    for (const world::BodySpec& body : scene.bodies)
        for (const world::BodySpec* shape : body.shapes()) {
            if (const world::MeshSource* mesh = shape->meshSource()) files.add(mesh->mesh);
            files.add(shape->finish.skin);
            files.add(shape->finish.texture);
        }
    for (const world::ColliderSpec& collider : scene.colliders) {
        files.add(collider.mesh);
        if (collider.meshData != nullptr)
            for (const std::string& named : collider.meshData->files) files.add(named);
        files.add(collider.finish.texture);
        for (const world::ColliderSpec& part : collider.parts) {
            files.add(part.mesh);
            if (part.ownFinish) files.add(part.ownFinish->texture);
        }
    }
    return files.take();
}

std::vector<UsedFile> pictureFiles(const world::SceneSpec& scene) {
    Files files;
    files.add(scene.environment.image);
    for (const world::BodySpec& body : scene.bodies)
        for (const world::BodySpec* shape : body.shapes()) {
            files.add(shape->finish.skin);
            files.add(shape->finish.texture);
        }
    for (const world::ColliderSpec& collider : scene.colliders) {
        files.add(collider.finish.texture);
        for (const world::ColliderSpec& part : collider.parts)
            if (part.ownFinish) files.add(part.ownFinish->texture);
    }
    return files.take();
}

std::vector<std::string> changedSince(std::span<const UsedFile> files) {
    std::vector<std::string> changes;
    for (const UsedFile& file : files)
        if (!core::isThere(file.path))
            changes.push_back(file.path + " is gone");
        else if (contentOf(file.path) != file.content)
            changes.push_back(file.path + " has changed");
    return changes;
}

}  // namespace taut::scene
